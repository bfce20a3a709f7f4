#pragma once

#include "param/atlas.h"
#include "param/refined_surface.h"

namespace gsp {

/// A map without folds of a refined surface.
struct RefinedMap {
  RefinedSurface refined;
  Atlas atlas;                ///< of the compact form of `refined`
  std::vector<int> vertex;    ///< per vertex of `refined`, its number in the atlas, -1 for those that are out
  std::vector<int> halfedge;  ///< per half-edge of the atlas's surface, its number in `refined`
};

/// Takes added vertices out of a map again where it stays upright, and its pieces thick enough, without them, also on edges of
/// the base. Patch corners stay. O(V).
RefinedMap coarsen(RefinedMap map);

}  // namespace gsp
