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

/// Untangles folded faces: in the discs around them, with their rims, the boundary and all corners held, minimises
/// `DistortionEnergy` while ε is driven to zero (Garanzha et al. 2021). The rest of the map stays bit for bit. A disc that
/// does not come free, or comes free wrongly wound, is left as it was, grown to at most so many rings of vertices around the
/// folds (and a number of vertices that bounds the time), and tried again; so folds may
/// remain, and `find_folds` tells. Vertices keep their charts, which they may leave.
RepairReport repair_folds(Atlas& atlas, int most_rings, Progress& progress);

}  // namespace gsp
