#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "coder/codec.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "metrics/surface_distance.h"
#include "param/options.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Sizes of streams for which base, features and level are chosen.
inline const std::vector<std::size_t> kRatedBytes = {1024, 2048, 4096, 8192, 16384};

/// The stream by which base, features and level are chosen: lifted Butterfly. Throws what `encode` throws.
Bytes rated_stream(const SemiregularMesh& mesh, Progress& progress);

/// The PSNR of a stream's first `bytes` against a surface with its tree; nothing where they decode to no area, from
/// which distances to thousands of faces at one point take minutes. Throws what `decode` and `surface_distance` throw.
std::optional<double> prefix_psnr(const Mesh& surface, const SurfaceTree& tree, const Bytes& stream, std::size_t bytes,
                                  const DistanceOptions& sampling, Progress& progress);

/// What maps of one surface are worth to the coder: made quickly, without flips of base edges, remeshed, encoded with
/// lifted Butterfly, decoded at some sizes and measured. A single number of the same stream in full differs by some
/// tenths of a dB; its rank among others is what counts.
class MapWorth {
 public:
  struct Value {
    int base_vertices = 0;  ///< of the map: more than asked for where the simplification could not go on
    double psnr_db = 0.0;   ///< mean over the budgets
  };

  /// `budgets`: bytes. `fewest_faces`: of the remeshes, which have at most four times as many.
  MapWorth(Mesh mesh, std::vector<std::size_t> budgets, double fewest_faces);

  /// Of `options` the base's size, gamma, mu, weights and features count. Nothing where there is no map. A budget that
  /// holds no more than a header counts as if each halving lost 12 dB. The same for any number of threads. Throws
  /// Error(Cancelled).
  std::optional<Value> of(ParameterizeOptions options, Progress& progress) const;

 private:
  double mean_psnr(const Bytes& stream, Progress& progress) const;

  const Mesh mesh_;
  const SurfaceTree tree_;
  const std::vector<std::size_t> budgets_;
  const double fewest_faces_;
};

}  // namespace gsp
