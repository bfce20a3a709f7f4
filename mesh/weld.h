#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// For every position the smallest index at exactly the same place (+0 and -0 agree, a NaN agrees with its own bits).
/// O(n log n), whatever the positions are, which a hash table of hostile input is not.
std::vector<int> first_at_same_position(const std::vector<Vec3>& positions);

/// Joins vertices at exactly the same place; kept ones stay in order. Faces keep their number and order.
Mesh weld(const Mesh& mesh);

}  // namespace gsp
