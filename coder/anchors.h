#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace GSP_PUBLIC gsp {

/// What someone would use instead: one coded size and the surface that comes back.
struct AnchorPoint {
  std::size_t bytes = 0;
  std::optional<int> quantization_bits;  ///< a coordinate; none: coordinates as they are, in single precision
  int faces = 0;
  Mesh decoded;
};

/// Codes a triangle mesh by Draco's edgebreaker at its best compression (speed 0, the tool's -cl 10) and decodes it
/// again. `quantization_bits` is 1 to 30, or none: then Draco loses no more than what single precision does.
/// Throws Error(BadOption, NoFaces).
AnchorPoint draco_round_trip(const Mesh& mesh, std::optional<int> quantization_bits);

/// What the next edge to collapse is and where its vertex goes.
enum class Decimation {
  /// Sums of squared distances to the planes of all faces merged into a vertex, which goes where the sum is least
  /// (Garland, Heckbert 1997); boundary edges hold planes across the surface.
  Quadrics,
  /// The volume between the surfaces before and after a collapse, which the vertex keeps at zero as a whole (Lindstrom,
  /// Turk 1998). The surface lies on both sides of the input, where that of quadrics has less than the volume of a
  /// ball.
  Volume,
};

/// Decimates to several face counts, which must be positive and fall, in one pass. A result has the count asked for or
/// up to two faces fewer; one of at least the input's count is the input. Counts that no valid collapse reaches are
/// left out, so the results may be fewer than the counts. Keeps topology, boundaries and every component. O(F log F),
/// 100,000 faces take 3 CPU s. Throws Error(NonManifoldEdge, NonManifoldVertex, BadOption, Cancelled).
std::vector<Mesh> decimate(const Mesh& mesh, const std::vector<int>& face_counts, Decimation decimation,
                           Progress& progress);

}  // namespace gsp
