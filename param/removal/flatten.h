#pragma once

#include <vector>

#include "param/map/lattice.h"
#include "param/removal/triangle_complex.h"

namespace gsp {

/// The star of a vertex in the plane under z^a: the vertex at 0, ring[k] at r_k^a·exp(i a θ_k) with a = 2π/Θ (interior)
/// or π/Θ (boundary, first and last ring vertex on the real axis), scaled so that the farthest ring vertex has
/// radius 1. The ring polygon is star-shaped about 0: angles and radii that would break that (spikes, coincident
/// vertices) are moved toward their mean as little as needed, and the exponent of the radii is bounded. `positions` are
/// those of the surface.
void flatten_star(const std::vector<Vec3>& positions, const Star& star, std::vector<Complex>& ring);

/// Barycentric coordinates of p with respect to a, b, c; the triangle must have area.
inline std::array<double, 3> barycentric(Complex p, Complex a, Complex b, Complex c) {
  const double whole = cross(b - a, c - a);
  const double wb = cross(p - a, c - a) / whole;
  const double wc = cross(b - a, p - a) / whole;
  return {1.0 - wb - wc, wb, wc};
}

}  // namespace gsp
