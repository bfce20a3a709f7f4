#pragma once

#include <memory>
#include <vector>

#include "mesh/progress.h"
#include "param/atlas.h"
#include "param/shrinking_map.h"

namespace gsp {

/// A map onto the base complex without folds, on a surface that has vertices added where the map needs them. Makes the
/// removals once more, carrying a homeomorphism (`OverlayMap`), and takes out the vertices it can do without. Pieces too
/// small for rounding may be left folded where the surface is degenerate, so ask `find_folds`. Throws Error(InvalidMap,
/// Cancelled).
Atlas injective_map(std::shared_ptr<const Surface> surface, const std::vector<Removal>& removals, Progress& progress);

}  // namespace gsp
