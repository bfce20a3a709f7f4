#pragma once

#include <vector>

#include "param/map/lattice.h"

namespace gsp {

/// Keeps the part of a convex polygon, counter-clockwise, that lies to the left of the line from a to b. O(corners).
inline void clip_to_left(std::vector<Complex>& convex, Complex a, Complex b) {
  std::vector<Complex> clipped;
  const std::size_t n = convex.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Complex p = convex[i], q = convex[(i + 1) % n];
    const double dp = cross(b - a, p - a), dq = cross(b - a, q - a);
    if (dp >= 0.0) clipped.push_back(p);
    if ((dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0)) clipped.push_back(p + dp / (dp - dq) * (q - p));
  }
  convex.swap(clipped);
}

/// The mean of some points, of which there is one at least.
inline Complex mean(const std::vector<Complex>& points) {
  Complex sum = 0.0;
  for (Complex z : points) sum += z;
  return sum / static_cast<double>(points.size());
}

}  // namespace gsp
