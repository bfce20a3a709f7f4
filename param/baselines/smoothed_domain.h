#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "param/map/base_complex.h"

namespace gsp {

/// z -> turn·z + shift, a rigid motion of the plane.
struct PlaneMotion {
  Complex turn = 1.0, shift = 0.0;

  Complex apply(Complex z) const { return turn * z + shift; }
  PlaneMotion inverse() const { return {1.0 / turn, -shift / turn}; }
  /// (f * g)(z) = f(g(z)).
  friend PlaneMotion operator*(const PlaneMotion& f, const PlaneMotion& g) {
    return {f.turn * g.turn, f.apply(g.shift)};
  }
};

/// A triangle of dyadic points of one base face: their indices as `SmoothedDomain::at` has them.
struct DyadicTriangle {
  int face;
  std::array<int, 3> i, j;  ///< of its corners, counter-clockwise
};

/// A triangle of the finest grid of a base face, with the corners (i, j), (i+1, j), (i, j+1), or one that hangs down:
/// (i+1, j), (i+1, j+1), (i, j+1).
struct GridTriangle {
  int face, i, j;
  bool down;

  DyadicTriangle corners() const {
    if (down) return {face, {i + 1, i + 1, i}, {j, j + 1, j + 1}};
    return {face, {i, i + 1, i}, {j, j, j + 1}};
  }
};

/// Calls visit(GridTriangle) for those of a face with n dyadic points along an edge less one.
template <class Visit>
void for_each_grid_triangle(int face, int n, Visit&& visit) {
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      visit(GridTriangle{face, i, j, false});
      if (i + j < n - 1) visit(GridTriangle{face, i, j, true});
    }
}

/// The base domain with its true side lengths, and the dyadic points of its faces where Loop subdivision of the
/// parameters moves them (Lee et al. 1998, "smoothing"): a stencil within a face is averaged in the face's plane, one
/// across a base edge in the two faces unfolded about it. Base vertices stay, and points on the boundary. Where Loop's
/// step would fold a dyadic triangle, or leave less than a share of its area, the step of its corners is shortened, so
/// that the points move by a homeomorphism of the domain.
class SmoothedDomain {
 public:
  /// `corners`: of each base face in its own plane, counter-clockwise, edge lengths equal on both sides of an edge.
  /// `base` must outlive it. O(faces·4^levels).
  SmoothedDomain(const BaseComplex& base, std::vector<std::array<Complex, 3>> corners, int levels);

  const BaseComplex& base() const { return base_; }
  /// 2^levels, the dyadic points along a base edge less one.
  int steps() const { return n_; }
  const std::array<Complex, 3>& corners(int face) const { return corners_[face]; }
  /// From the plane of the neighbour across a half-edge, which has a twin, to the plane of the half-edge's face.
  const PlaneMotion& unfold(int h) const { return unfold_[h]; }
  /// Where the dyadic point with weights (n-i-j, i, j)/n of the face's corners has moved, in the face's plane.
  Complex at(int face, int i, int j) const { return grids_[face][index(n_, i, j)]; }
  /// Points of all levels whose step was shortened, those on base edges once a face.
  int shortened() const { return shortened_; }

 private:
  using Grid = std::vector<Complex>;

  void subdivide();
  Complex loop_point(int face, int i, int j) const;
  Complex even_point(int face, int i, int j) const;
  Complex odd_point(int face, int i, int j) const;
  Complex straight_point(int face, int i, int j) const;
  void shorten_folding(const std::vector<Grid>& loop, const std::vector<Grid>& straight, std::vector<Grid>& finer);

  static std::size_t index(int n, int i, int j) {
    return static_cast<std::size_t>(j) * (n + 1) - static_cast<std::size_t>(j) * (j - 1) / 2 + i;
  }
  Complex at_edge(int face, int k, int along, int depth) const;
  Complex behind_edge(int face, int k, int along, int depth) const;

  const BaseComplex& base_;
  std::vector<std::array<Complex, 3>> corners_;
  std::vector<PlaneMotion> unfold_;  ///< per half-edge
  std::vector<Grid> grids_;          ///< per face
  int n_ = 1;
  int shortened_ = 0;
};

/// The corners of each base face in a plane, with the distances between its vertices on the surface.
std::vector<std::array<Complex, 3>> true_shapes(const BaseComplex& base, const std::vector<Vec3>& positions);

}  // namespace gsp
