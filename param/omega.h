#pragma once

#include <vector>

#include "param/parameterize.h"
#include "param/triangle_complex.h"

namespace gsp {

/// Where every vertex of the surface lies on the shrinking complex: a vertex of the complex, or a point of one triangle.
struct Location {
  int triangle = -1;    ///< -1 for vertices of the complex
  double weight1 = 0.0; ///< barycentric weight of the triangle's corner 1
  double weight2 = 0.0; ///< and of corner 2
};

/// Where a point of the star's triangle k lies in the plane of the flattened ring.
inline Complex flat_in_star(const TriangleComplex& complex, const Star& star, const std::vector<Complex>& ring, int k,
                            const Location& at) {
  const int m = complex.corner_index(at.triangle, star.center);
  const double weight[3] = {1.0 - at.weight1 - at.weight2, at.weight1, at.weight2};
  return weight[(m + 1) % 3] * ring[k] + weight[(m + 2) % 3] * ring[(k + 1) % star.size()];
}

/// What removing a vertex would cost and how its hole would be filled.
struct Candidate {
  bool feasible = false;
  OmegaRecord parts;  ///< remaining_vertices is not set
  std::vector<RingTriangle> triangles;
};

/// Prices vertex removals with the paper's Ω (§3.1.1): σ, ρ and δ shifted to zero, weighted by the patch areas. The hole is
/// filled by the triangulation of least Σ A (γ(σ-1)² + μ(ρ-1)² + (δ-1)²), found by dynamic programming over the flattened ring
/// (ρ between two new triangles is left out there, and counted in the price). δ is measured on at most `kSamples` points of
/// the star, evenly strided, so that late removals with large patches stay cheap. Safe to use from several threads, one
/// pricer each.
class Pricer {
 public:
  static constexpr int kSamples = 96;
  static constexpr int kLargestRing = 32;

  Pricer(const Surface& surface, const TriangleComplex& complex, const std::vector<Location>& locations,
         const std::vector<std::vector<int>>& points, const ParameterizeOptions& options);

  void price(int vertex, Candidate& candidate);

  /// Star of the vertex priced last.
  const Star& star() const { return star_; }

 private:
  struct Sample {
    Complex flat;
    double area;
    int first_edge, last_edge;
  };
  struct SampleEdge {
    Complex flat;  ///< difference of the ends in the plane
    double length; ///< on the surface
  };
  struct Terms {
    double area = 0.0, sigma = 1.0, delta = 1.0, triangle_area = 0.0;
  };

  Complex flat_position(int vertex) const;
  void collect_samples();
  void add_sample(int vertex, double weight);
  bool flat_of(int vertex, Complex& flat) const;
  Terms terms(const RingTriangle& t) const;
  double outer_dispersion(const RingTriangle& t, double area) const;
  bool triangulate(Candidate& candidate);

  const Surface& surface_;
  const TriangleComplex& complex_;
  const std::vector<Location>& locations_;
  const std::vector<std::vector<int>>& points_;
  const ParameterizeOptions& options_;

  Star star_;
  std::vector<Complex> ring_;
  std::vector<double> outer_area_;  ///< per ring edge, area of the triangle behind it; 0 on a boundary
  std::vector<Sample> samples_;
  std::vector<SampleEdge> edges_;
  std::vector<double> best_;
  std::vector<int> split_;
};

}  // namespace gsp
