#pragma once

#include <string>
#include <vector>

#include "experiments/report/findings.h"
#include "mesh/progress.h"

namespace gsp {

/// One figure: its files relative to the report's folder, and what it shows.
struct RunFigure {
  std::string png, svg;
  std::string caption;
};

/// Draws what the run has the numbers or artefacts for into FOLDER/figures, each by gnuplot with the program that draws
/// it beside it; maps of the first `maps` models that have one, with a note where there are more. Throws Error:
/// ToolMissing, CannotWrite, Cancelled, and what reading artefacts throws.
std::vector<RunFigure> run_figures(const Run& run, const Findings& found, const std::string& folder, int maps,
                                   Progress& progress);

}  // namespace gsp
