#pragma once

#include <string>
#include <vector>

#include "experiments/plot/gnuplot.h"
#include "experiments/report/run_figures.h"

namespace gsp {

/// Figures of a report and the programs that draw them, one for each, by runs of gnuplot. One run draws figures of one
/// kind alone, since gnuplot keeps the pen of the last figure and names it in the next one's SVG.
struct RunPlots {
  std::vector<RunFigure> figures;
  std::vector<std::vector<FigureProgram>> runs;
};

// Figures that gnuplot draws, PNG and SVG. Each function appends what the run has numbers for. Throw what reading
// artefacts throws.

/// Figure 7: a curve a model, and up to four models side by side.
void curve_figures(const Run& run, RunPlots& plots);
/// BD-rate bars: bytes over those of the reference at equal PSNR, a group a model.
void bar_figure(const Run& run, const Findings& found, RunPlots& plots);
/// Where exactly two numeric options of the reference's method vary: mean BD-rate over them as a heat map, and that of
/// each model.
void heat_figure(const Run& run, const Findings& found, RunPlots& plots);
/// Figure 5d: cost of the removals of each model's reference, stages marked.
void cost_figures(const Run& run, const Findings& found, RunPlots& plots);
/// Table 1: remeshing errors of the maps beside the paper's.
void error_figure(const Run& run, RunPlots& plots);

}  // namespace gsp
