#pragma once

#include <array>
#include <vector>

#include "param/map/development.h"
#include "remesh/surface_point.h"

namespace gsp {

/// Place of lattice point (i, j) among the (n+1)(n+2)/2 of a chart's triangle, row by row.
inline std::size_t lattice_index(int n, int i, int j) { return static_cast<std::size_t>(j) * (2 * n + 3 - j) / 2 + i; }

/// Lattice point s steps along side k of a triangle of n, from its corner k to the next.
inline std::array<int, 2> along_side(int n, int k, int s) {
  if (k == 0) return {s, 0};
  if (k == 1) return {n - s, s};
  return {0, n - s};
}

/// The faces over one chart, sampled at the points (i + jω) / n, i, j >= 0, i + j <= n, of its triangle.
class ChartSamples {
 public:
  /// `pieces`: those of this chart; kept by reference, as is `map`. Scan conversion in lattice coordinates, borders
  /// included, so that a point between two faces is always found; the best fit wins, then the smallest face index.
  /// O(pieces + samples).
  ChartSamples(const Parameterization& map, const std::vector<FacePiece>& pieces, int n);

  /// Points that no face holds, as a map with folds leaves them, take the nearest place in the faces of the points
  /// around them, spreading inward. They stay without a face where the whole chart is.
  void fill_gaps();

  /// Takes the points of side k, from corner k to the next, to the edges of the surface that run along it.
  void put_on_crease(int k);

  const SurfacePoint& at(int i, int j) const { return samples_[lattice_index(n_, i, j)].point; }

 private:
  struct Sample {
    SurfacePoint point;
    int piece = -1;
  };

  void scan(int piece);
  Sample nearest_around(int i, int j) const;
  SurfacePoint nearest_in(int piece, Complex z) const;

  const Parameterization& map_;
  const std::vector<FacePiece>& pieces_;
  int n_;
  std::vector<Sample> samples_;
};

}  // namespace gsp
