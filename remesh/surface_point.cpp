#include "remesh/surface_point.h"

namespace gsp {

namespace {

/// A weight this small is a point on an edge or a corner, whose position then is exact.
constexpr double kOnBorder = 1e-13;

std::array<double, 3> snapped(std::array<double, 3> w, double least) {
  double sum = 0.0;
  for (double& x : w) {
    if (!(x > least)) x = 0.0;
    sum += x;
  }
  for (double& x : w) x /= sum;
  return w;
}

}  // namespace

std::array<double, 3> snapped_weights(std::array<double, 3> w) { return snapped(w, kOnBorder); }

SurfacePoint on_crease(SurfacePoint point) {
  // Rounding of charts moves a point off an edge by 1e-16 of them, and so by less than this of the height of any face
  // that is not smaller than 1e-8 of its chart.
  constexpr double kOffCrease = 1e-8;
  point.weights = snapped(point.weights, kOffCrease);
  return point;
}

Vec3 position_at(const Mesh& surface, const SurfacePoint& point) {
  const Triangle& t = surface.faces[point.face];
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (point.weights[k] > 0.0) sum += point.weights[k] * surface.positions[t[k]];
  return sum;
}

}  // namespace gsp
