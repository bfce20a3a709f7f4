#pragma once

#include "param/atlas/atlas.h"

namespace gsp {

/// L2 stretch of the map from the base to the surface (Sander et al. 2001), 1 for an isometry up to one global scale.
/// It grows where the surface is sampled too thinly, so it tells whether a further round of relaxation helps the
/// remesh. A face that is folded or nearly so counts as if its image had 1/1000 of its fair share of the base. O(F).
double l2_stretch(const Atlas& atlas);

}  // namespace gsp
