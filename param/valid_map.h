#pragma once

#include <memory>
#include <vector>

#include "mesh/progress.h"
#include "param/atlas.h"
#include "param/shrinking_map.h"

namespace gsp {

/// Maps a surface without folds onto the complex that the removals leave, on a surface that has vertices added where the map
/// needs them: carries a homeomorphism (`OverlayMap`) through the removals and takes out the vertices it can do without.
/// Where a removal would leave pieces too small for rounding, it and all after it are dropped from `removals`.
/// Throws Error(Cancelled).
Atlas injective_map(std::shared_ptr<const Surface> surface, std::vector<Removal>& removals, Progress& progress);

}  // namespace gsp
