#pragma once

#include <vector>

#include "coder/bitplane_coder.h"
#include "mesh/mesh.h"

namespace gsp {

/// Integers of which a stream that ends at `state` makes the most: where it ends, a magnitude that is just under its
/// threshold becomes significant, or one just over it does not, if that lowers squared error in squared thresholds +
/// bit_worth times the price in bits. Prices are those of the contexts; all nodes end at the same importance
/// (bitplane_coder.h), so that one price holds for all. `state` is that of a stream of the same nodes; what it has not
/// spoken of stays. O(N).
BitplaneCoefficients rate_distortion_choice(const BitplaneCoefficients& integers, const BitplaneState& state,
                                            double bit_worth);

/// How far a surface is moved along its normals, which is its distance to first order.
class SurfaceError {
 public:
  explicit SurfaceError(Mesh mesh);
  /// Sum of squares over the area, up to a factor, where vertex v comes to lie at moved[v].
  double of(const std::vector<Vec3>& moved) const;

 private:
  std::vector<Vec3> positions_, normals_;  ///< normals as long as the square root of the area around
};

}  // namespace gsp
