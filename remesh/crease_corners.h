#pragma once

#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// The base vertices, ascending, in which two creases of a mesh meet at an angle: the edges of `finest` along them turn
/// by more than 34.5 degrees there, as no curve does over an edge of a fine level. `positions`: #V of it. O(E).
std::vector<int> crease_corners(const SubdivisionLevel& finest, int base_vertices, const std::vector<Vec3>& positions);

}  // namespace gsp
