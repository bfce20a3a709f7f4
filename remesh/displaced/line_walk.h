#pragma once

#include <optional>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// Where a line meets a surface near a known place of it: walks from `face` towards the line over faces that look along
/// `direction`, and so never on to another sheet. Returns t where the surface is met at origin + t·direction; nothing
/// where the walk ends at a boundary, at a face that looks the other way, or after too many faces. O(faces walked).
std::optional<double> walk_to_line(const SubdivisionLevel& level, const std::vector<Vec3>& positions, int face,
                                   const Vec3& origin, const Vec3& direction);

/// Where a surface's boundary curves meet planes, each near a known vertex.
class BoundaryWalk {
 public:
  /// O(E). `level` is kept by reference.
  explicit BoundaryWalk(const SubdivisionLevel& level);

  /// Walks along the boundary from `vertex` to the plane through `origin` at right angles to `direction`, the way that
  /// starts towards it. Nothing where `vertex` is not on a boundary, has several, or the curve turns away first.
  std::optional<Vec3> to_plane(const std::vector<Vec3>& positions, int vertex, const Vec3& origin,
                               const Vec3& direction) const;

 private:
  std::vector<std::array<int, 2>> beside_;  ///< #V, the boundary's vertices before and after, -1 where there is not one
};

}  // namespace gsp
