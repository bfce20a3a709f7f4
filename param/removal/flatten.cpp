#include "param/removal/flatten.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

namespace gsp {

namespace {
constexpr double kSmallestAngle = 1e-3;   // radians, so that coincident neighbours keep an order
constexpr double kSmallestRadius = 0.01;  // of the largest, in the plane
constexpr double kLargestPower = 4.0;     // of radii, so that spikes do not tear neighbours to the rim and to 0
constexpr double kLargestAngle = 0.92 * std::numbers::pi;  // of one triangle in the plane
}  // namespace

void flatten_star(const std::vector<Vec3>& positions, const Star& star, std::vector<Complex>& ring) {
  const int n = star.size();
  const int wedges = static_cast<int>(star.triangles.size());
  assert(n >= 2 && wedges == n - star.boundary);
  const Vec3 center = positions[star.center];
  // Until it is placed, a ring vertex stands for its radius and the angle from it to the next.
  ring.resize(n);
  const auto radius = [&](int k) { return ring[k].real(); };
  const auto angle = [&](int k) { return ring[k].imag(); };
  double largest = 0.0;
  for (int k = 0; k < n; ++k) {
    ring[k] = (positions[star.ring[k]] - center).norm();
    largest = std::max(largest, radius(k));
  }
  if (largest <= 0.0) largest = 1.0;
  double total = 0.0;
  for (int k = 0; k < wedges; ++k) {
    const Vec3 a = positions[star.ring[k]] - center, b = positions[star.ring[(k + 1) % n]] - center;
    ring[k].imag(std::max(std::atan2(a.cross(b).norm(), a.dot(b)), kSmallestAngle));
    total += angle(k);
  }
  const double full = star.boundary ? std::numbers::pi : 2.0 * std::numbers::pi;
  const double power = full / total;
  double widest = 0.0;
  for (int k = 0; k < wedges; ++k) {
    ring[k].imag(angle(k) * power);
    widest = std::max(widest, angle(k));
  }
  const double mean = full / wedges;
  if (widest > kLargestAngle && mean < kLargestAngle) {
    const double keep = (kLargestAngle - mean) / (widest - mean);
    for (int k = 0; k < wedges; ++k) ring[k].imag(mean + keep * (angle(k) - mean));
  }
  double direction = 0.0;
  for (int k = 0; k < n; ++k) {
    const double r = std::max(std::pow(radius(k) / largest, std::min(power, kLargestPower)), kSmallestRadius);
    const double next = k < wedges ? angle(k) : 0.0;
    ring[k] = star.boundary && k == n - 1 ? Complex(-r, 0.0) : std::polar(r, direction);
    direction += next;
  }
}

}  // namespace gsp
