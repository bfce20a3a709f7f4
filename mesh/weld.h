#pragma once

#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {

/// For every position the smallest index at exactly the same place (+0 and -0 agree, a NaN agrees with its own bits).
/// O(n log n), whatever the positions are, which a hash table of hostile input is not.
std::vector<int> first_at_same_position(const std::vector<Vec3>& positions);

/// For every position the index of a kept one within `distance` > 0 of it. Positions are taken in order and kept unless
/// one that was kept before is as near; of several the smallest index is taken. So nothing moves by more than
/// `distance`, and what is kept lies further apart. Positions that are not finite are kept. O(n log n).
std::vector<int> first_within(const std::vector<Vec3>& positions, double distance);

/// A surface of which some vertices are joined.
struct WeldedMesh {
  Mesh mesh;
  std::vector<int> vertices;  ///< #V index of each vertex before
};

/// Joins vertices. `first`: for each the one it becomes, which is no later and becomes itself, as above. Those that are
/// left stay in order; faces keep their number and order.
WeldedMesh weld(const Mesh& mesh, const std::vector<int>& first);

/// The same for vertices within `share` of the diagonal of the surface's bounding box, 0 for those at the same place.
WeldedMesh weld(const Mesh& mesh, double share);

}  // namespace gsp
