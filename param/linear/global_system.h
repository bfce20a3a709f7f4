#pragma once

#include <vector>

#include "param/atlas/atlas.h"
#include "param/linear/weights.h"

namespace gsp {

/// Solves the global parameterization system (§3.2.1, equation 2), z_i = Σ c_ij τ_ij(z_j), for the vertices marked in
/// `solved` (#V; never a patch corner), all others being held. Returns #V positions in the vertices' present charts,
/// which they may have left. One direct factorization of a complex matrix, of Cholesky where the weights are symmetric.
/// Throws Error(SolverFailed).
std::vector<Complex> solve_global(const Atlas& atlas, const LinearWeights& weights, const std::vector<char>& solved);

/// The same for `vertices`, ascending, alone: their positions, in that order. Of the size of their number, whatever the
/// surface has besides.
std::vector<Complex> solve_vertices(const Atlas& atlas, const LinearWeights& weights, const std::vector<int>& vertices);

/// #V: vertices that are neither isolated, nor a patch corner, nor on a boundary.
std::vector<char> interior_vertices(const Atlas& atlas);

/// Gives every boundary vertex the chart of its base boundary edge, where rounding put it into another one beside a
/// corner.
void seat_boundary(Atlas& atlas);

/// Where boundary vertices belong: on their base boundary edge, spaced by arc length between the two corners. #V
/// positions in the charts of a seated boundary; of other vertices where they are.
std::vector<Complex> boundary_by_arc_length(const Atlas& atlas);

}  // namespace gsp
