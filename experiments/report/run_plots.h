#pragma once

#include <string>
#include <vector>

#include "experiments/report/run_figures.h"

namespace gsp {

// Figures that gnuplot draws into FOLDER/figures, PNG and SVG, each with the program that draws it beside it. Each
// appends what the run has numbers for. Throw Error: ToolMissing, CannotWrite, and what reading artefacts throws.

/// Figure 7: a curve a model, and up to four models side by side.
void curve_figures(const Run& run, const std::string& folder, std::vector<RunFigure>& figures);
/// BD-rate bars: bytes over those of the reference at equal PSNR, a group a model.
void bar_figure(const Run& run, const Findings& found, const std::string& folder, std::vector<RunFigure>& figures);
/// Where exactly two numeric options of the reference's method vary: mean BD-rate over them as a heat map, and that of
/// each model.
void heat_figure(const Run& run, const Findings& found, const std::string& folder, std::vector<RunFigure>& figures);
/// Figure 5d: cost of the removals of each model's reference, stages marked.
void cost_figures(const Run& run, const Findings& found, const std::string& folder, std::vector<RunFigure>& figures);
/// Table 1: remeshing errors of the maps beside the paper's.
void error_figure(const Run& run, const std::string& folder, std::vector<RunFigure>& figures);

}  // namespace gsp
