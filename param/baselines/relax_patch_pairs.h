#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"
#include "param/linear/weights.h"

namespace gsp {

/// The baseline of the paper's figure 1c (Hybrid Meshes, Guskov et al. 2002): for each pair of edge-adjacent patches in
/// turn the vertices in the two are relaxed together (equation 2), what lies beyond the boundary of their union being
/// held; all pairs so many times. It smooths across the edge between the two, but each solution stops at the boundary
/// that it was given. Vertices that leave the pair are given the patches they lie in. Where the solution would fold
/// faces, which an outline across faces of the surface allows, the vertices there are held too, and at last the whole
/// pair: a map without folds stays one. One small factorization a pair, a few where it folds. Throws Error:
/// SolverFailed, Cancelled.
void relax_patch_pairs(Atlas& atlas, const LinearWeights& weights, int passes, Progress& progress);

}  // namespace gsp
