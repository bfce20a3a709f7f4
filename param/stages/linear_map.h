#pragma once

#include "mesh/progress.h"
#include "param/options.h"
#include "param/stages/smoothed_map.h"

namespace gsp {

/// The paper's map (§3.3): the global system and the corner relaxation in turn, then its folds untangled. Where they do
/// not come free the solution is approached over maps that have none. `injective` is a map without folds to start from,
/// and so is the result. Throws Error: SolverFailed, Cancelled.
SmoothedMap linear_map(const Atlas& injective, const ParameterizeOptions& options, Progress& progress);

}  // namespace gsp
