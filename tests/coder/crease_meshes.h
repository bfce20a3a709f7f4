#pragma once

#include <algorithm>
#include <cmath>

#include "tests/coder/sample_meshes.h"

namespace gsp::samples {

inline constexpr double kTurn = 6.283185307179586;

/// Makes creases of the base edges that `sharp` says yes to, of their ends.
template <class Sharp>
void crease(SemiregularMesh& mesh, Sharp sharp) {
  for (const auto& [a, b] : base_level(mesh.base_vertices, mesh.base_faces).edges)
    if (sharp(mesh.positions[a], mesh.positions[b])) mesh.creases.push_back({std::min(a, b), std::max(a, b)});
  std::sort(mesh.creases.begin(), mesh.creases.end());
}

/// The cube [-1, 1]^3, two faces a side, vertex number in bits x, y, z.
inline Mesh cube() {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) mesh.positions.push_back({v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0});
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int o = side << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      if (side)
        mesh.faces.insert(mesh.faces.end(), {{o, o + u, o + u + v}, {o, o + u + v, o + v}});
      else
        mesh.faces.insert(mesh.faces.end(), {{o, o + u + v, o + u}, {o, o + v, o + u + v}});
    }
  return mesh;
}

/// The cube with its twelve edges as creases, its sides bent by `height`: creases stay where they are.
inline SemiregularMesh creased_cube(int level, double height = 0.0) {
  SemiregularMesh mesh = refine(cube(), level, [](const Vec3& p) { return p; });
  crease(mesh, [](const Vec3& a, const Vec3& b) { return (a - b).squaredNorm() < 5.0; });
  for (Vec3& p : mesh.positions) {
    const Vec3 q = p;
    for (int k = 0; k < 3; ++k)
      if (std::abs(std::abs(q[k]) - 1.0) < 1e-12) {
        const double s = q[(k + 1) % 3], t = q[(k + 2) % 3];
        p[k] += q[k] * height * (1 - s * s) * (1 - t * t) * std::cos(2 * s + t);
      }
  }
  return mesh;
}

/// A cylinder of radius 1 and height 2 over a base of `sides` corners a ring, with flat lids; `middle` moves the points
/// between the rims, which are the creases.
template <class Middle>
SemiregularMesh cylinder(int sides, int level, Middle middle) {
  Mesh base;
  for (int z : {-1, 0, 1})
    for (int i = 0; i < sides; ++i) base.positions.push_back({static_cast<double>(i), 1.0, static_cast<double>(z)});
  base.positions.push_back({0.0, 0.0, -1.0});
  base.positions.push_back({0.0, 0.0, 1.0});
  for (int ring = 0; ring < 2; ++ring)
    for (int i = 0; i < sides; ++i) {
      const int a = ring * sides + i, b = ring * sides + (i + 1) % sides;
      base.faces.push_back({a, b, b + sides});
      base.faces.push_back({a, b + sides, a + sides});
    }
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    base.faces.push_back({j, i, 3 * sides});
    base.faces.push_back({2 * sides + i, 2 * sides + j, 3 * sides + 1});
  }
  // Angle in units of sides, radius, height; along edges that wrap around the angle goes on.
  SemiregularMesh mesh = refine(base, 0, [](const Vec3& p) { return p; });
  const auto levels = subdivision_levels(mesh.base_vertices, mesh.base_faces, level);
  for (int l = 0; l < level; ++l)
    for (const auto& [a, b] : levels[l].edges) {
      Vec3 p = mesh.positions[a], q = mesh.positions[b];
      if (p.y() == 0.0) p.x() = q.x();
      if (q.y() == 0.0) q.x() = p.x();
      q.x() -= sides * std::round((q.x() - p.x()) / sides);
      mesh.positions.push_back((p + q) / 2);
    }
  mesh.level = level;
  for (Vec3& p : mesh.positions) {
    const double angle = kTurn * p.x() / sides;
    p = {p.y() * std::cos(angle), p.y() * std::sin(angle), p.z()};
    if (std::abs(p.z()) < 1.0) p = middle(p);
  }
  crease(mesh, [](const Vec3& a, const Vec3& b) {
    return std::abs(a.head<2>().norm() - 1.0) < 1e-9 && std::abs(b.head<2>().norm() - 1.0) < 1e-9 && a.z() == b.z() &&
           std::abs(a.z()) == 1.0;
  });
  return mesh;
}
inline SemiregularMesh cylinder(int sides, int level) {
  return cylinder(sides, level, [](const Vec3& p) { return p; });
}

/// Two caps of spheres that meet at right angles in a wavy rim, a crease.
inline SemiregularMesh lens(int level) {
  SemiregularMesh mesh = refine(shapes::octahedron(), level, [](const Vec3& p) { return p; });
  crease(mesh, [](const Vec3& a, const Vec3& b) { return std::abs(a.z()) < 1e-9 && std::abs(b.z()) < 1e-9; });
  for (Vec3& p : mesh.positions) {
    // The octahedron's height is 1 less the distance to the axis in its own norm.
    const double height = std::abs(p.z()), side = p.z() < 0.0 ? -1.0 : 1.0;
    const double angle = std::atan2(p.y(), p.x()), radius = 1.0 - height;
    const double rim = 0.1 * std::cos(3 * angle) * radius * radius * radius;
    p = {radius * std::cos(angle), radius * std::sin(angle),
         rim + side * (std::sqrt(2.0 - radius * radius) - 1.0) * (1.0 + 0.2 * p.x())};
  }
  return mesh;
}

/// Two flat squares glued along their sides, a crease that bends in its four corners.
inline SemiregularMesh pillow(int level) {
  Mesh base;
  base.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  base.faces = {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}};
  SemiregularMesh mesh = refine(base, level, [](const Vec3& p) { return p; });
  crease(mesh, [](const Vec3& a, const Vec3& b) { return (a - b).squaredNorm() < 1.5; });
  mesh.corners = {0, 1, 2, 3};
  return mesh;
}

}  // namespace gsp::samples
