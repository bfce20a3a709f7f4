#pragma once

#include <string>
#include <vector>

#include "experiments/report/run_figures.h"

namespace gsp {

// Figures that are rendered into FOLDER/figures, PNG alone. Throw what reading artefacts and rendering throw.

/// For each of the first `most` models whose reference has a map: figure 8, patches, iso-lines and the remesh; figure
/// 2, anisotropy and area; figure 1, smoothness of every method's map, on one scale. Notes how many models more have
/// maps.
void map_figures(const Run& run, const Findings& found, const std::string& folder, int most,
                 std::vector<RunFigure>& figures, Progress& progress);

/// Figure 9: discs of 5 and 9 sectors, by Loop subdivision and by the global system, beside each other. Of any run with
/// maps.
void disc_figure(const Run& run, const std::string& folder, std::vector<RunFigure>& figures);

}  // namespace gsp
