#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace gsp {

/// Exact nearest point on a triangle surface: a bounding volume hierarchy, built once, asked from any thread.
/// A triangle without area still is a segment or a point that can be the nearest. Throws Error(NoFaces).
class SurfaceTree {
 public:
  explicit SurfaceTree(const Mesh& mesh);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  /// Squared distance from p to the surface, exact up to rounding. `hint` starts from that face (-1: none) and receives
  /// the nearest one: neighbouring queries run several times faster with it; the distance does not depend on it.
  double squared_distance(const Vec3& p, int& hint) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

struct DistanceOptions {
  std::size_t samples = 1000000;  ///< per direction, area-stratified
  std::uint64_t seed = 1;
};

/// One direction, from samples on `a` to the nearest point of `b`, in the coordinates' own unit.
struct OneWayDistance {
  double mean = 0.0;
  double rms = 0.0;
  double hausdorff = 0.0;     ///< largest over the samples: a lower bound of the true one
  /// Of the RMS, from the squared differences between neighbouring strata; their trend makes it err to the safe side.
  double rms_standard_error = 0.0;
  std::size_t samples = 0;
};

struct SurfaceDistance {
  OneWayDistance forward;   ///< from a to b
  OneWayDistance backward;  ///< from b to a
  double diagonal = 0.0;    ///< of a's bounding box: the peak of PSNR

  double rms() const;        ///< the larger of the two directions
  double mean() const;
  double hausdorff() const;
  double psnr_db() const;    ///< 20·log10(diagonal / rms()); infinite for equal surfaces
  double standard_error_db() const;
};

/// Distance between surface `a` (the reference) and `b`, both ways (algorithms.md §7): samples are one per stratum of equal
/// area, weights are equal, so mean and RMS are those over area.
/// The same bits for any number of threads. Throws Error(NoFaces, BadOption).
SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options, Progress& progress);

/// The same where the trees are at hand, for many comparisons against one reference.
SurfaceDistance surface_distance(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const DistanceOptions& options,
                                 Progress& progress);

}  // namespace gsp
