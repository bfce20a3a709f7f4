#pragma once

#include <string>
#include <vector>

#include "experiments/report/findings.h"
#include "mesh/progress.h"

namespace gsp {

struct ReportOptions {
  std::string recipe;    ///< of a store with several; empty stands for the latest
  bool figures = true;   ///< draw the figures, which wants gnuplot
  int map_models = 100;  ///< models whose maps are drawn, the first of the run, 0..100,000: 0.7 CPU s each
  int views = 3;         ///< cells of each model in the 3D view, 0..100
  /// Views hold decoded surfaces of up to eight sizes, for browsers without WebAssembly. They do so too where gsp was
  /// built without emscripten; else they hold the streams, which take a third of the bytes, and decode any size.
  bool stored_surfaces = false;
};

struct ReportResult {
  Findings findings;
  std::vector<std::string> files;  ///< what was made, with the folder, index.html first
};

/// Writes a report on a run (report/run.h) into a folder, which is made: index.html, which opens from disk without a
/// network, views/ with the surfaces of its 3D view, figures/, curve.csv. Files of an earlier report are replaced.
/// Throws what reading the run throws, and Error: CannotWrite, ToolMissing, Cancelled.
ReportResult make_report(const std::string& run_folder, const std::string& folder, const ReportOptions& options,
                         Progress& progress);

}  // namespace gsp
