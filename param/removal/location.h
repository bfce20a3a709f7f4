#pragma once

#include <vector>

#include "param/map/lattice.h"
#include "param/removal/triangle_complex.h"

namespace gsp {

/// Where every vertex of the surface lies on the shrinking complex: a vertex of the complex, or a point of one
/// triangle.
struct Location {
  int triangle = -1;     ///< -1 for vertices of the complex
  double weight1 = 0.0;  ///< barycentric weight of the triangle's corner 1
  double weight2 = 0.0;  ///< and of corner 2
};

/// Where a point of the star's triangle k lies in the plane of the flattened ring.
inline Complex flat_in_star(const TriangleComplex& complex, const Star& star, const std::vector<Complex>& ring, int k,
                            const Location& at) {
  const int m = complex.corner_index(at.triangle, star.center);
  const double weight[3] = {1.0 - at.weight1 - at.weight2, at.weight1, at.weight2};
  return weight[(m + 1) % 3] * ring[k] + weight[(m + 2) % 3] * ring[(k + 1) % star.size()];
}

}  // namespace gsp
