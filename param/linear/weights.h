#pragma once

#include <array>
#include <vector>

#include "param/atlas/atlas.h"
#include "param/options.h"

namespace gsp {

/// An edge of a linear system for positions: with all others, z(start) wants to be the mean, by the weights, of
/// to_start(z(end)), and z(end) that of its inverse.
struct Spring {
  int start, end;       ///< vertices, the same where an intrinsic edge returns
  Transition to_start;  ///< from the end's chart to that of the start
  double at_start, at_end;
};

/// The weights of one kind on one surface, in the global system (§3.2.1) and on discs.
///
/// - Mean value (Floater 2003): w_ij = (tan(α/2) + tan(β/2)) / |p_i - p_j| with α, β the angles at i beside edge ij,
/// positive
///   and not symmetric. Lengths and half-angle tangents are bounded away from 0 and infinity, so that degenerate faces
///   leave the weights positive and finite.
/// - Cotangent: (cot α + cot β)/2 of the angles opposite to the edges of the intrinsic Delaunay triangulation, which
/// are
///   symmetric and not negative: the system is Hermitian, and its solution the map of least Dirichlet energy.
/// - Uniform: 1, symmetric.
class LinearWeights {
 public:
  /// The surface must outlive the weights.
  LinearWeights(const Surface& surface, Weights kind);

  /// Whether `at_start` and `at_end` are the same on all springs.
  bool symmetric() const { return kind_ != Weights::MeanValue; }

  /// Those of a map on some faces, distinct and ascending. They are right at vertices that have all their faces among
  /// them, and of no use at the others, which should be held.
  std::vector<Spring> springs(const Atlas& atlas, const std::vector<int>& faces) const;

 private:
  std::vector<Spring> delaunay_springs(const Atlas& atlas, const std::vector<int>& faces) const;

  const Surface& surface_;
  const Weights kind_;
  /// #E by edge: [0] of its end in the row of its start, [1] of its start in the row of its end. Empty for cotangents.
  std::vector<std::array<double, 2>> edges_;
};

}  // namespace gsp
