#pragma once

#include <array>
#include <vector>

#include "param/atlas.h"

namespace gsp {

/// Corner relaxation (§3.2.2): around every interior patch corner the vertices within `radius` (below 1/2, so that no two
/// regions meet; in units of a base edge) are mapped to a disc by z^(6/k), the outermost are held, the inside is solved
/// with the corner free, and the vertex nearest 0 becomes the corner; positions, charts and transitions of the region
/// follow from the disc. A region that is no disc or whose disc map folds is left alone. Corners are independent of each
/// other and computed in parallel. Returns the corners that moved; the global system has to be solved again.
int relax_corners(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double radius);

/// Where the solution is folded or wrongly wound beside a corner, lays out the region of `radius` around it from the disc
/// instead, with the vertex nearest 0 drawn onto it: the winding is right by construction. Only regions that come out free
/// of folds are taken. Returns how many. The global solution outside the regions stays.
int settle_corners(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double radius);

/// Gives corners that lost a full turn to a vertex near by (see `Folds`) their winding back, each in the least number of
/// rings that suffices, on a map without folded faces. Returns how many came right.
int unwind_corners(Atlas& atlas, const std::vector<std::array<double, 2>>& weights);

}  // namespace gsp
