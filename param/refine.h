#pragma once

#include <vector>

#include "param/atlas.h"

namespace gsp {

/// Splits edges of the surface at their middle, where the map needs more freedom than the input's vertices give (§4, last
/// paragraph): the new vertex lies at the middle of the edge on the surface and in its chart, so the map stays what it was.
/// New vertices come last; a split face is replaced in place, its other half comes last. The atlas gets a surface of its own.
void split_edges(Atlas& atlas, const std::vector<int>& edges);

/// Splits what no position of the free vertices could map without a fold: edges between two patch corners that do not run
/// along one base edge, and the links of corners that have too few faces for their valence (each face spans less than
/// 180°, together they must span valence·60°). Returns the number of vertices added.
int refine_at_corners(Atlas& atlas);

}  // namespace gsp
