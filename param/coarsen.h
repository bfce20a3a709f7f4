#pragma once

#include "param/atlas.h"
#include "param/refined_surface.h"

namespace gsp {

/// Takes added vertices out of a map again where it stays upright, and its pieces thick enough, without them, also on edges of
/// the base. `atlas` is a map without folds of the compact form of `refined`. O(V).
Atlas coarsen(const Atlas& atlas, RefinedSurface refined, const RefinedSurface::Compact& compact);

}  // namespace gsp
