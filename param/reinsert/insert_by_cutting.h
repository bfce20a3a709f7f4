#pragma once

#include "param/reinsert/star_hole.h"

namespace gsp {

/// Puts the centre of a star into its hole without moving anything: the pieces in the hole are cut along the star's
/// edges, which bend in the map. Vertices that were added in the hole before stay where they are needed. False where
/// rounding or a patch corner's ambiguous chart forbids it; the map is of no use then.
bool cut_in(StarHole& hole);

}  // namespace gsp
