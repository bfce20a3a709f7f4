#pragma once

#include "mesh/progress.h"
#include "param/atlas.h"

namespace gsp {

/// Lowers the `DistortionEnergy` of a whole map free of folds, over all vertices that are no patch corners and not on a
/// boundary, by at most so many steps of L-BFGS, preconditioned with the Cholesky factor of the Dirichlet form. No step
/// leaves the maps without folds. The energy knows nothing of patches, so its minimiser is as smooth across patch edges as
/// within them. Vertices are then given the charts they lie in. One sparse factorization, and per step two triangular
/// solves and one pass over the faces. Returns false, the map unchanged, where nothing was gained.
bool lower_distortion(Atlas& atlas, int steps, Progress& progress);

}  // namespace gsp
