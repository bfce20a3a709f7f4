#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace GSP_PUBLIC gsp {

/// Exact nearest point on a triangle surface: a bounding volume hierarchy, built once, asked from any thread.
/// A triangle without area still is a segment or a point that can be the nearest.
class SurfaceTree {
 public:
  /// Throws the errors of `require_finite_surface`.
  explicit SurfaceTree(const Mesh& mesh);
  /// Made in two fifths of the time, of a surface whose faces lie beside each other as those of `like` do, such as
  /// another decoded prefix of one stream. Throws Error(BadOption) where the numbers of faces differ, too.
  SurfaceTree(const Mesh& mesh, const SurfaceTree& like);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  /// Squared distance from p to the surface, exact up to rounding. `hint` starts from that face (-1: none) and receives
  /// the nearest one: neighbouring queries run several times faster with it; the distance does not depend on it.
  double squared_distance(const Vec3& p, int& hint) const;

  /// How the tree is made, for the metrics that walk it themselves.
  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

struct DistanceOptions {
  std::size_t samples = 1000000;  ///< per direction
  std::uint64_t seed = 1;
  /// Decibels: samples are added until the standard error of each direction's RMS is at most this; 0 takes `samples`.
  double tolerance_db = 0.0;
  std::size_t most_samples = 1000000000;  ///< per direction, where a tolerance asks for more than `samples`
};

/// One direction, from samples on `a` to the nearest point of `b`, in the coordinates' own unit.
struct OneWayDistance {
  double mean = 0.0;
  double rms = 0.0;
  double quantile95 = 0.0;  ///< 95% of the area is nearer; from up to 2^20 of the samples, in bins 0.025% wide
  double hausdorff = 0.0;   ///< largest over the samples: a lower bound of the true one (hausdorff.h encloses it)
  /// Of the RMS, from the squared differences between neighbouring strata; their trend makes it err to the safe side.
  double rms_standard_error = 0.0;
  std::size_t samples = 0;

  double standard_error_db() const;  ///< of 20·log10(rms); 0 for no distance
};

struct SurfaceDistance {
  OneWayDistance forward;   ///< from a to b
  OneWayDistance backward;  ///< from b to a
  double diagonal = 0.0;    ///< of a's bounding box: the peak of PSNR
  double rounding = 0.0;    ///< `distance_rounding`: an RMS up to this is none

  double rms() const;  ///< the larger of the two directions
  double mean() const;
  double quantile95() const;
  double hausdorff() const;
  bool exact() const { return rms() <= rounding; }  ///< the surfaces are the same, up to the rounding of coordinates
  double psnr_db() const;                           ///< 20·log10(diagonal / rms()); infinite where it is exact
  double standard_error_db() const;                 ///< of the direction with the larger RMS
};

/// What computed distances between two surfaces may be too large by: 1e-13 of the largest coordinate of their faces,
/// some hundred times the rounding of one operation.
double distance_rounding(const Mesh& a, const Mesh& b);

/// Distance between surface `a` (the reference) and `b`, both ways (algorithms.md §7). Mean, RMS and quantile are those
/// over area. Samples are one per stratum; strata are smaller where the vertices and samples taken before found the
/// squared distance to vary (sample_density.h), and each sample weighs as the area it stands for.
/// The same bits for any number of threads. Throws Error(NoFaces, NonFinite, BadOption).
SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options, Progress& progress);

/// The same where the trees are at hand, for many comparisons against one reference.
SurfaceDistance surface_distance(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b,
                                 const DistanceOptions& options, Progress& progress);

/// The same where both trees are at hand.
SurfaceDistance surface_distance(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const SurfaceTree& tree_b,
                                 const DistanceOptions& options, Progress& progress);

/// #V distance of each vertex of `from` to the surface, in the coordinates' unit.
std::vector<double> vertex_distances(const Mesh& from, const SurfaceTree& to);

}  // namespace gsp
