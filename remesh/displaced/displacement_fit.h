#pragma once

#include <vector>

#include "remesh/displaced/fit_target.h"
#include "remesh/filters/displacement.h"

namespace gsp {

/// Displacements that put each vertex on the surface, on its own normal.
struct PiercedDisplacements {
  Displacements displacements;
  int missed = 0;  ///< vertices whose normal meets no surface near where the map has them: filled in from around
};

/// Along each normal to where it leaves the target beside the vertex's point by the map (line_walk.h), taken within
/// three lengths of the edges around that and where no face beside it turns against the target's; elsewhere the mean of
/// the vertices around. On boundaries to where the target's boundary crosses the plane of normal and conormal, or else
/// the part in that plane of the way to the map's point. O(V).
PiercedDisplacements pierce_target(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                                   const FitTarget& target);

struct DisplacementFitOptions {
  double stiffness;      ///< > 0, of springs along edges between the moves of their ends; samples weigh 1 over a face
  double damping;        ///< > 0, of each round's moves
  double reach;          ///< > 0, edges of the smooth surface that a vertex moves in one round at most
  int most_rounds;       ///< >= 0
  double tangential;     ///< > 0, weight of what lies neither along the normal nor along the conormal
  double enough = 0.03;  ///< share of the energy by which a round must lower it for another one
  /// #F of the base, or none: where the remesh breaks without more. Midpoints of edges count there (edge_watch.h), and
  /// springs are ten times stiffer.
  std::vector<char> watched = {};
};

/// Moves of vertices from the smooth surface, in least squares nearest to the target: distances of its samples from the
/// displaced surface and of the vertices from it, in rounds of Gauss-Newton steps, each taken only where it lowers the
/// energy. Moves along the surface are held back, not forbidden: what is left of them says where one number a vertex is
/// not enough. `samples` and `start`, #V, are where it begins; samples leave as nearest places. The same bits for any
/// number of threads. O(V + samples).
std::vector<Vec3> fit_displacements(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                                    const FitTarget& target, const DisplacementFitOptions& options,
                                    std::vector<SurfaceSample>& samples, const std::vector<Vec3>& start);

}  // namespace gsp
