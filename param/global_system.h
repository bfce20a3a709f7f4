#pragma once

#include <array>
#include <vector>

#include "param/atlas.h"

namespace gsp {

/// Solves the global parameterization system (§3.2.1, equation 2), z_i = Σ c_ij τ_ij(z_j), one complex unknown per vertex
/// that is neither a patch corner nor on a boundary, for the given edge weights (see `mean_value_weights`), and then moves
/// vertices that left their patch to the chart they lie in. Returns the number of vertices that lie in no chart (they are
/// beside corners, where the solution is folded). Throws Error(SolverFailed).
///
/// Vertices closer than `held_radius` to a patch corner (in units of a base edge, within their chart) stay where they are. In
/// the charts the solution near a corner of valence k is a sum of powers D^(k/6), D^(k/6-1), conj(D)^(1-k/6), ... of a smooth
/// disc coordinate D; a corner that is a little off its place excites the lower ones, which fold or wind wrongly. So the
/// layout from the disc (`relax_corners`) is kept there and the two are alternated, as in Schwarz's method.
int solve_global(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double held_radius);

/// Puts every boundary vertex onto its base boundary edge, spaced by arc length between the two corners.
void place_boundary(Atlas& atlas);

}  // namespace gsp
