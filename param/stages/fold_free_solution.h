#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"
#include "param/linear/weights.h"

namespace gsp {

/// Moves a map that is free of folds to the solution of the global system (§3.2.1), the boundary going to its places by
/// arc length. Where the solution is folded or wrongly wound it is approached in steps, each of which is untangled
/// (`repair_folds`); vertices around a fold that does not come free stay behind, the fewer the better. So the map stays
/// free of folds; the number of vertices that stayed behind is returned. Afterwards vertices that left their patch have
/// the chart they lie in. Throws Error(SolverFailed).
int solve_without_folds(Atlas& atlas, const LinearWeights& weights, Progress& progress);

}  // namespace gsp
