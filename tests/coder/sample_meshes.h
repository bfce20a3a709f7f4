#pragma once

#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/semiregular.h"

namespace gsp::samples {

/// Quadrisects a base and gives every vertex the position that `place` makes of its midpoint-refined one.
template <class Place>
SemiregularMesh refine(const Mesh& base, int level, Place place) {
  SemiregularMesh mesh;
  mesh.level = level;
  mesh.base_vertices = base.vertex_count();
  mesh.base_faces = base.faces;
  mesh.positions = base.positions;
  const std::vector<SubdivisionLevel> levels = subdivision_levels(mesh.base_vertices, mesh.base_faces, level);
  for (int l = 0; l < level; ++l)
    for (const auto& [a, b] : levels[l].edges) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
  for (Vec3& p : mesh.positions) p = place(p);
  return mesh;
}

/// A sphere with smooth bumps on an icosahedron's base: smooth everywhere but at the base's edges in parameters.
inline SemiregularMesh bumpy_sphere(int level) {
  return refine(shapes::icosahedron(), level, [](const Vec3& p) {
    const Vec3 n = p.normalized();
    return Vec3(n * (1.0 + 0.1 * std::sin(4 * n.x()) * std::cos(3 * n.y() + 1) + 0.05 * std::sin(7 * n.z())));
  });
}

/// A wavy sheet with a boundary.
inline SemiregularMesh wavy_sheet(int level) {
  return refine(shapes::grid(3, 4), level,
                [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.2 * std::sin(2 * p.x()) * std::cos(1.5 * p.y())); });
}

/// Positions without any smoothness.
inline SemiregularMesh noise(const Mesh& base, int level) {
  Random random(11);
  return refine(base, level,
                [&](const Vec3& p) { return Vec3(p + Vec3(random.uniform(), random.uniform(), random.uniform())); });
}

}  // namespace gsp::samples
