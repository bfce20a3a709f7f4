#pragma once

#include <cmath>
#include <optional>

#include "mesh/mesh.h"

namespace gsp {

// Products of vectors with their sums in a fixed order and by operations that IEEE 754 fixes: what a decoder's bits
// follow from may use these and not Eigen's, whose order and use of fused multiply-add depend on the machine's vector
// unit.

inline double dot(const Vec3& a, const Vec3& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vec3 times(const Eigen::Matrix3d& m, const Vec3& v) {
  Vec3 product;
  for (int r = 0; r < 3; ++r) product[r] = (m(r, 0) * v[0] + m(r, 1) * v[1]) + m(r, 2) * v[2];
  return product;
}

/// Nothing where the square of the length under- or overflows.
inline std::optional<Vec3> unit(const Vec3& v) {
  const double square = dot(v, v);
  if (!(square > 1e-300 && square < 1e300)) return std::nullopt;
  const double length = std::sqrt(square);
  return Vec3(v[0] / length, v[1] / length, v[2] / length);
}

}  // namespace gsp
