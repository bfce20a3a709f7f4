#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "param/map/development.h"
#include "remesh/surface_point.h"

namespace gsp {

/// A box in a chart's lattice coordinates, the weights of its corners 1 and 2.
struct ChartBox {
  std::array<double, 2> low = {2.0, 2.0}, high = {-1.0, -1.0};

  void add(Complex z) {
    const std::array<double, 3> w = chart_barycentric(z);
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], w[k + 1]);
      high[k] = std::max(high[k], w[k + 1]);
    }
  }
  /// The part within `other` too; low above high where there is none.
  ChartBox within(const ChartBox& other) const {
    ChartBox both;
    for (int k = 0; k < 2; ++k) {
      both.low[k] = std::max(low[k], other.low[k]);
      both.high[k] = std::min(high[k], other.high[k]);
    }
    return both;
  }
};

/// The faces over each chart, found by place: a grid of about as many cells as faces.
class ChartIndex {
 public:
  /// `pieces`: of each chart; kept by reference, as is `map`. O(pieces).
  ChartIndex(const Parameterization& map, const std::vector<std::vector<FacePiece>>& pieces);

  const Parameterization& map() const { return map_; }

  /// The corners of a piece's face in the chart.
  std::array<Complex, 3> corners(const FacePiece& piece) const {
    std::array<Complex, 3> c = map_.face_corners[piece.face];
    for (Complex& z : c) z = piece.motion.apply(z);
    return c;
  }

  /// Calls visit(piece) for each piece of a chart that meets a box, and for others near it; for some more than once.
  template <class Visit>
  void for_each_near(int chart, const ChartBox& box, Visit visit) const {
    const Grid& grid = grids_[chart];
    const std::array<std::array<int, 2>, 2> range = grid.range(box);
    for (int j = range[1][0]; j <= range[1][1]; ++j)
      for (int i = range[0][0]; i <= range[0][1]; ++i)
        for (int at = grid.begin[grid.cell(i, j)]; at < grid.begin[grid.cell(i, j) + 1]; ++at)
          visit(pieces_[chart][grid.entries[at]]);
  }

  /// The surface over a point of the chart's triangle: the best face that holds it, else the one that lies nearest
  /// among those around, as a map with folds has it. Throws Error(InvalidMap) where no face is over the chart.
  SurfacePoint at(int chart, Complex z) const;

 private:
  struct Grid {
    int n = 1;                 ///< cells along a side
    std::vector<int> begin;    ///< #n² + 1
    std::vector<int> entries;  ///< pieces, by cell

    std::size_t cell(int i, int j) const { return static_cast<std::size_t>(j) * n + i; }
    /// First and last cell that a box meets in each direction.
    std::array<std::array<int, 2>, 2> range(const ChartBox& box) const;
  };

  Grid grid_of(int chart) const;

  const Parameterization& map_;
  const std::vector<std::vector<FacePiece>>& pieces_;
  std::vector<Grid> grids_;
};

}  // namespace gsp
