#pragma once

#include <cmath>

#include "mesh/shapes.h"
#include "remesh/filters/displacement.h"

namespace gsp::samples {

/// A base as its own control mesh, on a grid of 1/16, displaced by 0.1 sin(3x + y) along the normals and on boundaries
/// by 0.05 cos(2x - y) across them, with x and y of the smooth surface.
inline SemiregularMesh displaced(const Mesh& base, int level) {
  const double grid = 0.0625;
  std::vector<Vec3> control = base.positions;
  for (Vec3& p : control)
    for (double& x : p) x = grid * std::nearbyint(x / grid);
  const auto levels = subdivision_levels(base.vertex_count(), base.faces, level);
  const SmoothSurface surface = smooth_surface(levels, control);
  Displacements numbers;
  for (const Vec3& p : surface.points) {
    numbers.along.push_back(0.1 * std::sin(3.0 * p.x() + p.y()));
    numbers.across.push_back(0.05 * std::cos(2.0 * p.x() - p.y()));
  }
  SemiregularMesh mesh{level, base.vertex_count(), base.faces, displaced_points(levels, surface, numbers)};
  mesh.control = ControlMesh{control, grid};
  return mesh;
}

}  // namespace gsp::samples
