#pragma once

#include <vector>

#include "mesh/progress.h"
#include "param/atlas.h"

namespace gsp {

struct RepairReport {
  int flipped_before = 0;  ///< faces without positive area in their chart
  int regions = 0;         ///< discs that were untangled
  std::vector<int> moved;  ///< vertices, increasing
};

/// Untangles folded faces: in the discs around them, with their rims, the boundary and all corners held, minimises the
/// foldover-free energy of Garanzha et al. 2021 (|J|²/χ + λ (det² + 1)/χ with the regularisation χ(ε) = (det + √(ε² + det²))/2
/// driven to zero), reference shapes being the surface's own triangles. The rest of the map stays bit for bit. A disc that
/// does not come free, or comes free wrongly wound, is left as it was, grown, and tried again up to a limit; so folds may
/// remain, and `find_folds` tells. Vertices keep their charts, which they may leave.
RepairReport repair_folds(Atlas& atlas, Progress& progress);

bool lower_distortion(Atlas& atlas, int steps);

}  // namespace gsp
