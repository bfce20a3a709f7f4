#pragma once

#include <optional>

#include "param/simplify/simplify.h"

namespace gsp {

/// The map of MAPS (Lee et al. 1998) as the bijection it is, not smoothed: the removals of a simplification made again
/// on the finest surface, which is cut along the edges of the complex. Vertices lie where MAPS carries them, but for
/// those of pieces that would be too small for rounding (`PlanarRegion::relax`), and no face is folded. MAPS' programs
/// carried the vertices alone and drew faces straight, which folds them where they cross patch edges. Nothing where a
/// piece is too small all the same: `unplaced` then names the place in space of the vertex that could not go. O(V log
/// V), with many pieces where edges of the complex wind about thin limbs.
std::optional<OverlayMap> maps_overlay(const SimplifyResult& simplified, std::optional<Vec3>* unplaced = nullptr);

}  // namespace gsp
