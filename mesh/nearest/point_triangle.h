#pragma once

#include <algorithm>
#include <cmath>

#include "mesh/mesh.h"

namespace gsp {

/// A triangle in its own orthonormal frame: the longest edge from the origin along x, the third corner at (x2, height).
/// With the longest edge as axis the frame is backward stable: the distance is that to a triangle whose corners moved
/// by a few units in the last place, however thin it is. A triangle without area acts as its longest edge, one without
/// extent as a point.
struct TriangleFrame {
  Vec3 origin, x_axis, y_axis;
  double length = 0.0, x2 = 0.0, height = 0.0;
  double inverse1 = 0.0, inverse2 = 0.0;  ///< 1 / squared length of the edges into the third corner; 0 for no length

  TriangleFrame() = default;
  TriangleFrame(const Vec3& a, const Vec3& b, const Vec3& c);
};

/// A group of points that are asked together, coordinate by coordinate, so that the compiler works on several at once.
template <int G>
struct PointGroup {
  alignas(64) double x[G], y[G], z[G];

  void set(std::size_t i, const Vec3& p) {
    x[i] = p.x();
    y[i] = p.y();
    z[i] = p.z();
  }
};

/// nearest[i] = min(nearest[i], squared distance of point i to the triangle). No branches: about 60 operations a point.
template <int G>
inline void nearer(const TriangleFrame& t, const PointGroup<G>& p, double* __restrict nearest) {
  const double ux = t.x_axis.x(), uy = t.x_axis.y(), uz = t.x_axis.z();
  const double vx = t.y_axis.x(), vy = t.y_axis.y(), vz = t.y_axis.z();
  const double wx = uy * vz - uz * vy, wy = uz * vx - ux * vz, wz = ux * vy - uy * vx;
  const double ox = t.origin.x(), oy = t.origin.y(), oz = t.origin.z();
  const double length = t.length, x2 = t.x2, height = t.height, back = t.x2 - t.length;
  const double inverse1 = t.inverse1, inverse2 = t.inverse2;
  for (int i = 0; i < G; ++i) {
    const double qx = p.x[i] - ox, qy = p.y[i] - oy, qz = p.z[i] - oz;
    const double x = qx * ux + qy * uy + qz * uz;
    const double y = qx * vx + qy * vy + qz * vz;
    const double z = qx * wx + qy * wy + qz * wz;
    const double xl = x - length;

    double s0 = x < length ? x : length;
    s0 = s0 > 0.0 ? s0 : 0.0;
    const double d0 = (x - s0) * (x - s0) + y * y;

    double s1 = (xl * back + y * height) * inverse1;
    s1 = s1 < 1.0 ? s1 : 1.0;
    s1 = s1 > 0.0 ? s1 : 0.0;
    const double x1 = xl - s1 * back, y1 = y - s1 * height;
    const double d1 = x1 * x1 + y1 * y1;

    double s2 = (x * x2 + y * height) * inverse2;
    s2 = s2 < 1.0 ? s2 : 1.0;
    s2 = s2 > 0.0 ? s2 : 0.0;
    const double x3 = x - s2 * x2, y3 = y - s2 * height;
    const double d2 = x3 * x3 + y3 * y3;

    const double side1 = back * y - height * xl, side2 = x * height - y * x2;
    double innermost = side1 < side2 ? side1 : side2;
    innermost = y < innermost ? y : innermost;
    double outside = d0 < d1 ? d0 : d1;
    outside = d2 < outside ? d2 : outside;
    outside = innermost > 0.0 ? 0.0 : outside;
    const double distance = z * z + outside;
    nearest[i] = distance < nearest[i] ? distance : nearest[i];
  }
}

}  // namespace gsp
