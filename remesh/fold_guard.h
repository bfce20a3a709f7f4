#pragma once

#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// Twice the vector area of the face between three points.
Vec3 doubled_area(const Triangle& face, const std::vector<Vec3>& positions);

/// Keeps vertices that move from folding the faces between them.
class FoldGuard {
 public:
  /// `surface_areas`: #F, twice the vector area of the surface over each face. Both are kept by reference.
  FoldGuard(const SubdivisionLevel& level, const std::vector<Vec3>& surface_areas)
      : level_(level), surface_areas_(surface_areas) {}

  /// Marks in `held`, #V, the corners of faces that turn against the surface over them, and of both faces of edges that
  /// fold to less than 30 degrees, with the vertices at `after` and not at `before`; false where none is newly marked.
  /// So with the held vertices put back to `before` again and again, no such face or edge is left in the end. O(F).
  bool hold(const std::vector<Vec3>& before, const std::vector<Vec3>& after, std::vector<char>& held) const;

 private:
  const SubdivisionLevel& level_;
  const std::vector<Vec3>& surface_areas_;
};

}  // namespace gsp
