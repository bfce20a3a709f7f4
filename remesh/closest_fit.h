#pragma once

#include <vector>

#include "remesh/closest_energy.h"
#include "remesh/fold_guard.h"
#include "remesh/semiregular.h"

namespace gsp {

/// How far a fit goes.
struct FitEffort {
  double stiffness;      ///< > 0, of the springs, where the samples over one face weigh 1
  double enough = 0.03;  ///< of the energy, by which a round must lower it for another one
  int most_rounds = 10;
};

/// Moves a remesh's vertices down the sum of the squared distances of `samples` to the nearest places of its surface,
/// wherever the map has them: along the surface as much as across it, so that edges turn into creases and vertices to
/// where the surface bends. What that moves is held together by springs along the edges, between the
/// moves from `start`, #V, of their ends: moves that are alike cost nothing, each on its own costs bytes in a code.
///
/// Rounds of Gauss-Newton steps (iterated closest points, each to the plane of its nearest face), each taken only where
/// it lowers the whole energy, so the distance never ends above that of `start`. Vertices on boundaries and creases
/// stay, and what `guard` holds. A rigid motion or scaling of all moves the result, up to rounding. The same bits on
/// any number of threads, which share the search for nearest places. O(V + samples).
std::vector<Vec3> fit_closest(const SubdivisionLevel& finest, const FoldGuard& guard,
                              std::vector<SurfaceSample> samples, const FitEffort& effort,
                              const std::vector<Vec3>& start);

}  // namespace gsp
