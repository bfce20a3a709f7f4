#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/curve/summary.h"

namespace gsp {

/// One panel: a model and its curves.
using PlotPanel = std::pair<std::string, std::vector<CurveSeries>>;

/// More panels side by side are wider than the 32,767 pixels that Cairo draws.
inline constexpr std::size_t kMostPlotPanels = 50;

/// A colour for each method, as #rrggbb: the method's own for its first label ("gsp", "gsp gamma=2"), further ones for
/// others in turn.
std::vector<std::string> method_colors(const std::vector<std::string>& methods);

/// The gnuplot program that draws up to `kMostPlotPanels` panels side by side to NAME.png and NAME.svg in its working
/// folder: PSNR over bytes (logarithmic), one line a curve, the first wider, remeshing ceilings dashed, sizes from
/// which on a curve is exact dotted. Of replicates the line is the mean and a band reaches from the lowest to the
/// highest. The data stand in it, so it can be restyled and run again.
std::string plot_script(const std::string& name, const std::vector<PlotPanel>& panels);

/// Writes FOLDER/NAME.gp and runs gnuplot on it; returns the names of the files made.
/// Throws Error: ToolMissing where gnuplot is absent or fails, CannotWrite.
std::vector<std::string> plot(const std::string& folder, const std::string& name, const std::vector<PlotPanel>& panels);

}  // namespace gsp
