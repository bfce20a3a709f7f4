#include "remesh/surface_point.h"

namespace gsp {

namespace {

/// A weight this small is a point on an edge or a corner, whose position then is exact.
constexpr double kOnBorder = 1e-13;

}  // namespace

std::array<double, 3> snapped_weights(std::array<double, 3> w) {
  double sum = 0.0;
  for (double& x : w) {
    if (!(x > kOnBorder)) x = 0.0;
    sum += x;
  }
  for (double& x : w) x /= sum;
  return w;
}

Vec3 position_at(const Mesh& surface, const SurfacePoint& point) {
  const Triangle& t = surface.faces[point.face];
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (point.weights[k] > 0.0) sum += point.weights[k] * surface.positions[t[k]];
  return sum;
}

}  // namespace gsp
