#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"

namespace gsp {

/// Lowers the `DistortionEnergy` of a whole map free of folds, over all its free vertices, by Newton steps with a
/// convex Hessian, until one gains less than `least_gain` of the energy. No step leaves the maps without folds. The
/// energy knows nothing of patches, so its minimiser is as smooth across patch edges as within them. Vertices are then
/// given the charts they lie in. One sparse Cholesky factorization a step. Returns false, the map unchanged, where
/// nothing was gained. Throws Error(Cancelled).
bool lower_distortion(Atlas& atlas, double least_gain, Progress& progress);

/// The same in overlapping blocks of some thousand vertices, each with everything else held, for a map that is already
/// smooth on the large: it takes no more memory than a block's. Keeps the map free of folds. O(V) a sweep. Throws
/// Error(Cancelled).
void lower_distortion_locally(Atlas& atlas, int sweeps, Progress& progress);

}  // namespace gsp
