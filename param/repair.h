#pragma once

#include "mesh/progress.h"
#include <array>
#include <vector>

#include "param/atlas.h"

namespace gsp {

struct RepairReport {
  int flipped_before = 0;  ///< faces without positive area in their chart
  int regions = 0;         ///< discs that were untangled
  int vertices_moved = 0;
};

/// Untangles the folded faces that the linear solution leaves beside corners: in the discs around them, with their rims and
/// all corners held, minimises the foldover-free energy of Garanzha et al. 2021 (|J|²/χ + λ (det² + 1)/χ with the
/// regularisation χ(ε) = (det + √(ε² + det²))/2 driven to zero), reference shapes being the surface's own triangles. The rest
/// of the solution stays bit for bit. A disc that does not come free is grown and tried again. A corner that comes free with a
/// full turn lost to a neighbour is unwound (`unwind_corners`, which takes the edge weights) and its disc untangled again.
/// Throws Error(InvalidMap) naming a face where the largest disc does not come free either.
RepairReport repair_folds(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, Progress& progress);

}  // namespace gsp
