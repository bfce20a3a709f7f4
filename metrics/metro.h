#pragma once

#include <cstddef>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "metrics/surface_distance.h"

namespace GSP_PUBLIC gsp {

/// One direction as Metro reports it. Its samples at vertices, edges and faces weigh the same, so mean and RMS are not
/// those over area.
struct MetroDistance {
  double mean = 0.0;
  double rms = 0.0;
  double maximum = 0.0;
  std::size_t vertex_samples = 0, edge_samples = 0, face_samples = 0;
};

struct MetroDistances {
  MetroDistance forward, backward;
  /// Of the joint bounding box of both surfaces, widened by 2% of its diagonal on every side: what Metro divides by
  /// where it says "wrt bounding box diagonal".
  double diagonal = 0.0;
};

/// What Metro 4.07 computes by default (Cignoni, Rocchini, Scopigno 1998, and the program's own accounting): every
/// vertex, edges at equal steps, similar triangles in faces, all with one weight. `samples` in [1, 2e9] is its -n, the
/// target per direction; 0 takes its default of ten per face of the larger mesh. Distances are exact, where Metro gives
/// up beyond its box. For comparison with published tables only. Throws Error(NoFaces, BadOption).
MetroDistances metro_distances(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const SurfaceTree& tree_b,
                               std::size_t samples, Progress& progress);

}  // namespace gsp
