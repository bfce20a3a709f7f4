#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "param/removal/triangle_complex.h"

namespace gsp {

/// What a replicate makes of a vertex's price: a factor within 1e-4 of 1, which depends on both numbers alone; 1 in
/// replicate 0. A price is taken at no more than 32 points of a star (`RemovalCost::kSamples`), so it means far fewer
/// digits than this changes.
double factor_of_chance(int replicate, int vertex);

/// What MAPS knows of a vertex (Lee et al. 1998, §3.1). `area`: of its star. `curvature`: sum of the absolute principal
/// curvatures, 2 ∫|H| over a third of the star, from the dihedral angles of its edges; on a boundary the curve's own
/// curvature is added. 0 for a star without area.
struct StarShape {
  double area = 0.0, curvature = 0.0;
};
StarShape star_shape(const Star& star, const std::vector<Vec3>& positions);

/// The order in which MAPS removes vertices (Lee et al. 1998, §3.1), as prices for a queue: in rounds, in each of which
/// no vertex goes whose neighbour went before it, and within a round by the mean of area and curvature, each over the
/// largest of the round. Vertices of a valence over 12 wait for a later round.
class MapsOrder {
 public:
  /// `positions`: of all vertices of the complex. Keeps references to both.
  MapsOrder(const TriangleComplex& complex, const std::vector<Vec3>& positions, int replicate);

  /// Weighs `vertices`, those that are left. Called before anything else is asked.
  void begin_round(const std::vector<int>& vertices);
  /// Of a vertex of the round: least first. Others have more than any vertex of the round.
  double price(int vertex) const { return due_[vertex] + weight_[vertex]; }
  /// Whether a vertex of this price is of the round.
  bool is_due(double price) const { return price < round_ + 1; }
  /// A neighbour has gone: the vertex waits for the next round.
  void hold(int vertex) { due_[vertex] = round_ + 1; }

 private:
  const TriangleComplex& complex_;
  const std::vector<Vec3>& positions_;
  const int replicate_;
  int round_ = -1;
  std::vector<int> due_;        ///< the round in which it may go
  std::vector<double> weight_;  ///< at least 0, at most 0.75
};

}  // namespace gsp
