#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Finds where lines pierce a surface, near a known point of it.
class Piercing {
 public:
  /// Keeps a reference to `surface`, whose edges have at most two faces. O(F).
  explicit Piercing(const Mesh& surface);

  struct Hit {
    int face;
    double along;  ///< the surface is met at origin + along * direction
  };

  /// Walks from `face` towards the line, over faces that look along `direction` only, and so never on to another sheet.
  /// Nothing where the walk ends at a boundary, at a face that looks the other way, or after too many faces.
  std::optional<Hit> walk(int face, const Vec3& origin, const Vec3& direction) const;

 private:
  const Mesh& surface_;
  std::vector<std::array<int, 3>> across_;  ///< #F, the face beyond each side, -1 on a boundary
};

}  // namespace gsp
