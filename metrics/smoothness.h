#pragma once

#include <optional>
#include <vector>

#include "mesh/export.h"
#include "metrics/statistics.h"
#include "param/map/parameterization.h"

namespace GSP_PUBLIC gsp {

/// How smooth a map is: on each edge between two faces, the Frobenius norm of the difference of the two faces' first
/// derivatives (the map from chart to surface, 2 x 2), which the paper's figure 1 shows. The second face is unfolded
/// into the first one's plane, so that the surface's own bends do not count, and given in the first one's chart; both
/// derivatives are in units in which total area on the surface is total area in the charts. 0 is smooth. Inside a
/// smooth map the difference falls with the faces' size, across a kink it does not, so it compares maps of the same
/// surface. The groups' means do not compare with each other: at a corner of other than six patches every smooth map is
/// singular, patch edges run into corners, and it is the larger faces that reach over them. `across_over_inside` allows
/// for both.
struct Smoothness {
  Statistics inside;     ///< edges whose two faces lie in one patch
  Statistics across;     ///< edges with faces on both sides of a patch edge, away from corners
  Statistics at_corner;  ///< edges with a base vertex in one of their two faces
  Statistics all;
  int inside_edges = 0, across_edges = 0, corner_edges = 0;
  /// Whether patch edges show: the geometric mean over `across` edges of the map's second derivative, over that of
  /// edges inside patches at the same distance from a corner. 1 where they do not, whatever the triangulation; at a
  /// kink it grows as faces get smaller. Geometric, since a few squeezed faces would decide on another mean, and a
  /// median would not see a kink on a third of the patch edges. The second derivative is the difference of the first
  /// ones over their mean size and over the difference that unit second derivatives in random directions give in faces
  /// of that shape. Empty where the map is linear inside its patches, or no distance has edges of both kinds.
  std::optional<double> across_over_inside;
  std::vector<double> faces;  ///< #F, mean over a face's edges weighted by their length; 0 where it has none
};

/// Statistics are weighted by a third of both faces' area. Edges of a face without area on the surface or in its chart,
/// and those of one or of more than two faces, are left out. Throws the errors of
/// `require_well_formed`. O(F log F).
Smoothness smoothness(const Parameterization& map);

}  // namespace gsp
