#pragma once

#include <vector>

#include "param/options.h"
#include "param/removal/location.h"
#include "param/removal/neighbour_lists.h"

namespace gsp {

/// What removing a vertex would cost and how its hole would be filled.
struct Candidate {
  bool feasible = false;
  OmegaRecord parts;  ///< remaining_vertices is not set
  std::vector<RingTriangle> triangles;
};

/// Prices vertex removals with the paper's Ω (§3.1.1): σ, ρ and δ shifted to zero, weighted by the patch areas. The
/// hole is filled by the triangulation of least Σ A (γ(σ-1)² + μ(ρ-1)² + (δ-1)²), found by dynamic programming over the
/// flattened ring (ρ between two new triangles is left out there, and counted in the price). δ is measured on at most
/// `kSamples` points of the star, evenly strided, so that late removals with large patches stay cheap. Safe to use from
/// several threads, one pricer each.
class RemovalCost {
 public:
  static constexpr int kSamples = 32;
  static constexpr int kLargestRing = 32;

  /// `neighbours`: of the surface. Keeps references to all of them.
  RemovalCost(const Surface& surface, const NeighbourLists& neighbours, const TriangleComplex& complex,
              const std::vector<Location>& locations, const std::vector<std::vector<int>>& points,
              const ParameterizeOptions& options);

  /// From here on an edge inside the complex may join two of its boundary vertices.
  void allow_chords() { chords_ = true; }

  /// `candidate`: with parts and triangles where it is feasible.
  void price(int vertex, Candidate& candidate);

  /// Whether its boundary and its component have a vertex to spare, and its ring is not too large. A corner of feature
  /// curves is never spared; inside a curve both copies go.
  bool leaves_surface(const Star& star) const;

 private:
  static constexpr int kMostSamples = kSamples + 1;  ///< with the vertex itself

  struct Sample {
    Complex flat;
    double area;
    int first_edge, last_edge;
  };
  struct SampleEdge {
    Complex flat;                   ///< difference of the ends in the plane
    double length, inverse_square;  ///< on the surface
  };
  struct Terms {
    double area = 0.0, sigma = 1.0, delta = 1.0, triangle_area = 0.0;
    double undistorted = 0.0;  ///< cost of a unit of area without δ
  };

  void lay_out(int vertex);
  void collect_samples();
  void add_sample(int vertex, Complex flat, double weight);
  bool flat_of(int vertex, Complex& flat) const;
  Terms outline(const RingTriangle& t) const;
  bool take_samples(const RingTriangle& t, double inner, double limit, Terms& terms) const;
  Terms terms(const RingTriangle& t) const;
  double outer_dispersion(const RingTriangle& t, double area) const;
  bool is_free_edge(int i, int j) const;
  bool triangulate(Candidate& candidate);
  void fill_best();

  const Surface& surface_;
  const NeighbourLists& neighbours_;
  const TriangleComplex& complex_;
  const std::vector<Location>& locations_;
  const std::vector<std::vector<int>>& points_;
  const ParameterizeOptions& options_;
  bool chords_ = false;

  Star star_;
  std::vector<Complex> ring_;
  std::vector<std::array<Complex, 3>> triangle_flat_;  ///< per triangle of the star, by the complex's corners
  std::vector<Vec3> corner_;                           ///< of the ring, on the surface
  std::vector<double> corner_area_;
  std::vector<double> length_;      ///< ring x ring, on the surface
  std::vector<char> barred_;        ///< ring x ring, what the filling must not have as an edge
  std::vector<double> outer_area_;  ///< per ring edge, area of the triangle behind it; 0 on a boundary
  std::vector<Sample> samples_;
  std::vector<SampleEdge> edges_;
  std::vector<double> best_;
  std::vector<int> split_;
};

}  // namespace gsp
