#pragma once

#include <string>
#include <vector>

#include "experiments/curve/curve.h"
#include "experiments/curve/summary.h"
#include "mesh/io.h"

namespace gsp {

struct CurveJobResult {
  std::vector<CurveSummary> models;  ///< in the order of the surfaces, failures included
  std::vector<std::string> files;    ///< what was made, with the folder
  bool failed() const;
};

/// Rate-distortion curves of several surfaces into a folder, which is made: curve.csv (rewritten as a whole after every
/// method, so that an interrupt loses no finished one), MODEL.png, .svg and .gp, MODEL-omega.csv, overview.png and .svg
/// for several models. A surface that fails is a summary with its cause, and the others go on.
/// Throws Error(Cancelled), Error(CannotWrite).
CurveJobResult curve_job(const std::vector<std::string>& surfaces, const std::string& folder, const ReadOptions& read,
                         const CurveOptions& options, Progress& progress);

}  // namespace gsp
