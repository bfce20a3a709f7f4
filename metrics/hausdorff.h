#pragma once

#include <cstddef>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "metrics/surface_distance.h"

namespace GSP_PUBLIC gsp {

/// A distance between surfaces that is certainly in [lower, upper], in the coordinates' own unit.
struct DistanceBounds {
  double lower = 0.0;
  double upper = 0.0;

  /// (upper - lower) / upper; 0 for no distance.
  double relative_width() const { return upper > 0.0 ? (upper - lower) / upper : 0.0; }
};

struct HausdorffBounds {
  DistanceBounds forward;   ///< largest distance of a point of a from b
  DistanceBounds backward;  ///< largest distance of a point of b from a
  DistanceBounds both() const;
};

struct HausdorffOptions {
  static constexpr double kLeastTolerance = 1e-6;
  double tolerance = 0.01;  ///< in [kLeastTolerance, 1]: stop where upper <= (1 + tolerance) * lower
  /// Pieces of triangles looked at in a direction, the triangles included; bounds are wider where they run out.
  std::size_t most_pieces = 20'000'000;
  /// Pieces that wait at once, beside the triangles themselves: they are the memory that is taken, 136 bytes each (0.6
  /// GB, for a moment twice that). Bounds are wider where there is no room for more.
  std::size_t most_waiting = 4'000'000;
};

/// Encloses the Hausdorff distance by branch and bound over the triangles of one surface against the tree of the other:
/// below, by distances of points; above, by the distance to one triangle, which is convex and so largest at a corner of
/// the piece, by the same for a piece cut in two near the bisector of two triangles, and by the Lipschitz bound.
/// Both are widened by the rounding, so a distance under 1e-13 of the largest coordinate comes out as [0, about that].
/// Faces without area count as the segments or points they are. The same bits for any number of threads.
/// Throws Error(NoFaces, BadOption, Cancelled).
HausdorffBounds hausdorff_bounds(const Mesh& a, const Mesh& b, const HausdorffOptions& options, Progress& progress);
HausdorffBounds hausdorff_bounds(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const SurfaceTree& tree_b,
                                 const HausdorffOptions& options, Progress& progress);

}  // namespace gsp
