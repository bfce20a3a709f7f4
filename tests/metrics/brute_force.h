#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "mesh/mesh.h"
#include "mesh/random.h"

namespace gsp {

/// Uniform in [-1, 1]^3.
inline Vec3 random_point(Random& random) {
  const double x = random.uniform(), y = random.uniform(), z = random.uniform();
  return Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

/// A second opinion that shares nothing with the kernel: Voronoi regions of corners, edges and face
/// (Ericson, Real-Time Collision Detection, 5.1.5).
inline double brute_force_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (p - (a + d1 / (d1 - d3) * ab)).norm();
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (p - (a + d2 / (d2 - d6) * ac)).norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return (p - (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b))).norm();
  return std::abs(ap.dot(ab.cross(ac).normalized()));
}

inline double brute_force_distance(const Vec3& p, const Mesh& mesh) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.faces)
    nearest =
        std::min(nearest, brute_force_distance(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
  return nearest;
}

/// Triangles of very different sizes anywhere in [-1, 1]^3, with a share of degenerate ones.
inline Mesh random_soup(int count, std::uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (int f = 0; f < count; ++f) {
    const Vec3 centre = random_point(random);
    const double size = std::pow(10.0, -3.0 * random.uniform());
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(centre + size * random_point(random));
    if (f % 10 == 0) mesh.positions[3 * f + 2] = 0.5 * (mesh.positions[3 * f] + mesh.positions[3 * f + 1]);
    if (f % 25 == 0) mesh.positions[3 * f + 1] = mesh.positions[3 * f + 2] = mesh.positions[3 * f];
    mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

}  // namespace gsp
