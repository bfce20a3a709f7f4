#include "remesh/normal/chart_index.h"

#include <algorithm>
#include <cmath>

#include "mesh/error.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

/// Boxes are taken this much larger, in chart units: far above rounding, far below a cell.
constexpr double kReach = 1e-9;
constexpr int kMostCells = 1024;

ChartBox box_of(const std::array<Complex, 3>& corners) {
  ChartBox box;
  for (Complex z : corners) box.add(z);
  return box;
}

/// The place of z in a face with the given corners in the chart, or as near to it as weights that are not negative get.
SurfacePoint place_in(int face, const std::array<Complex, 3>& c, Complex z) {
  SurfacePoint point;
  const double area = chart_area(c[0], c[1], c[2]);
  if (area == 0.0 || !std::isfinite(area)) return point;
  point.face = face;
  point.weights = {chart_area(z, c[1], c[2]) / area, chart_area(c[0], z, c[2]) / area,
                   chart_area(c[0], c[1], z) / area};
  point.fit = *std::min_element(point.weights.begin(), point.weights.end());
  if (!(point.fit > -kReach)) point.fit = std::max(point.fit, -1.0) - SurfacePoint::kNear;
  if (area < 0.0) point.fit -= SurfacePoint::kFlipped;
  point.weights = snapped_weights(point.weights);
  return point;
}

}  // namespace

ChartIndex::ChartIndex(const Parameterization& map, const std::vector<std::vector<FacePiece>>& pieces)
    : map_(map), pieces_(pieces), grids_(pieces.size()) {
  parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) grids_[c] = grid_of(static_cast<int>(c));
  });
}

ChartIndex::Grid ChartIndex::grid_of(int chart) const {
  const std::vector<FacePiece>& pieces = pieces_[chart];
  Grid grid;
  // Half of the cells lie in the chart's triangle.
  grid.n = std::clamp(static_cast<int>(std::sqrt(2.0 * static_cast<double>(pieces.size()))), 1, kMostCells);
  grid.begin.assign(static_cast<std::size_t>(grid.n) * grid.n + 1, 0);
  const auto for_each_cell = [&](auto visit) {
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const auto range = grid.range(box_of(corners(pieces[p])));
      for (int j = range[1][0]; j <= range[1][1]; ++j)
        for (int i = range[0][0]; i <= range[0][1]; ++i) visit(grid.cell(i, j), static_cast<int>(p));
    }
  };
  for_each_cell([&](std::size_t cell, int) { ++grid.begin[cell + 1]; });
  for (std::size_t cell = 1; cell < grid.begin.size(); ++cell) grid.begin[cell] += grid.begin[cell - 1];
  grid.entries.resize(grid.begin.back());
  std::vector<int> next(grid.begin.begin(), grid.begin.end() - 1);
  for_each_cell([&](std::size_t cell, int piece) { grid.entries[next[cell]++] = piece; });
  return grid;
}

std::array<std::array<int, 2>, 2> ChartIndex::Grid::range(const ChartBox& box) const {
  std::array<std::array<int, 2>, 2> range;
  for (int k = 0; k < 2; ++k) {
    // Clamped as numbers first: boxes of a map with folds may lie anywhere.
    const auto cell_of = [&](double x) { return static_cast<int>(std::floor(std::clamp(x * n, -1.0, n + 0.0))); };
    range[k] = {std::max(cell_of(box.low[k] - kReach), 0), std::min(cell_of(box.high[k] + kReach), n - 1)};
  }
  return range;
}

SurfacePoint ChartIndex::at(int chart, Complex z) const {
  SurfacePoint best;
  // A map without folds has a face at once.
  for (double reach = 0.0; best.face < 0 && reach <= 2.0; reach = reach > 0.0 ? 4.0 * reach : 0x1p-9) {
    ChartBox box;
    box.add(z);
    for (int k = 0; k < 2; ++k) {
      box.low[k] -= reach;
      box.high[k] += reach;
    }
    for_each_near(chart, box, [&](const FacePiece& piece) {
      const SurfacePoint found = place_in(piece.face, corners(piece), z);
      if (found.better_than(best)) best = found;
    });
  }
  if (best.face < 0) throw Error(Cause::InvalidMap, "no face of the surface covers a base face", Element::Face, chart);
  return best;
}

}  // namespace gsp
