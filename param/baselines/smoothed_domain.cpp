#include "param/baselines/smoothed_domain.h"

#include <algorithm>
#include <cmath>

namespace gsp {

namespace {

constexpr double kLeastShare = 0.1;     // of the area that a dyadic triangle has without Loop's step
constexpr double kShortest = 1.0 / 16;  // of the step, below which a point does not move
constexpr double kLeastHeight = 1e-3;   // of a base face over its first side: without height it would have no inside
constexpr double kLeastSide = 1e-12;

}  // namespace

std::vector<std::array<Complex, 3>> true_shapes(const BaseComplex& base, const std::vector<Vec3>& positions) {
  std::vector<std::array<Complex, 3>> shapes;
  for (const Triangle& t : base.faces) {
    const Vec3 &p = positions[base.vertices[t[0]]], &q = positions[base.vertices[t[1]]],
               &r = positions[base.vertices[t[2]]];
    const double side = std::max((q - p).norm(), kLeastSide);
    const double along = (q - p).dot(r - p) / side;
    const double height = std::sqrt(std::max((r - p).squaredNorm() - along * along, 0.0));
    shapes.push_back({0.0, side, Complex(along, std::max(height, kLeastHeight * side))});
  }
  return shapes;
}

SmoothedDomain::SmoothedDomain(const BaseComplex& base, std::vector<std::array<Complex, 3>> corners, int levels)
    : base_(base), corners_(std::move(corners)), unfold_(base.twins.size()) {
  for (std::size_t h = 0; h < base_.twins.size(); ++h) {
    const int twin = base_.twins[h];
    if (twin < 0) continue;
    const auto &here = corners_[h / 3], &there = corners_[twin / 3];
    const Complex from = here[h % 3], to = here[(h % 3 + 1) % 3];
    const Complex there_from = there[(twin % 3 + 1) % 3], there_to = there[twin % 3];
    const Complex turn = (to - from) / (there_to - there_from);
    unfold_[h] = {turn, from - turn * there_from};
  }
  for (const auto& c : corners_) grids_.push_back({c[0], c[1], c[2]});
  for (int level = 0; level < levels; ++level) subdivide();
}

/// The point `depth` rows inside edge k, `along` steps from corner k.
Complex SmoothedDomain::at_edge(int face, int k, int along, int depth) const {
  std::array<int, 3> weight;
  weight[k] = n_ - along - depth;
  weight[(k + 1) % 3] = along;
  weight[(k + 2) % 3] = depth;
  return at(face, weight[1], weight[2]);
}

/// The same behind edge k of the face, seen in the face's plane; `along` counts from the face's corner k + 1.
Complex SmoothedDomain::behind_edge(int face, int k, int along, int depth) const {
  const int twin = base_.twins[3 * face + k];
  return unfold_[3 * face + k].apply(at_edge(twin / 3, twin % 3, along, depth));
}

void SmoothedDomain::subdivide() {
  std::vector<Grid> loop(grids_.size()), straight(grids_.size());
  for (int f = 0; f < base_.face_count(); ++f)
    for (int j = 0; j <= 2 * n_; ++j)
      for (int i = 0; i + j <= 2 * n_; ++i) {
        loop[f].push_back(loop_point(f, i, j));
        straight[f].push_back(straight_point(f, i, j));
      }
  std::vector<Grid> finer = loop;
  n_ *= 2;
  shorten_folding(loop, straight, finer);
  grids_ = std::move(finer);
}

/// Shortens steps until every triangle keeps its share of area. With no step at all it has a quarter of an upright one.
void SmoothedDomain::shorten_folding(const std::vector<Grid>& loop, const std::vector<Grid>& straight,
                                     std::vector<Grid>& finer) {
  std::vector<std::vector<double>> share(finer.size());
  for (std::size_t f = 0; f < finer.size(); ++f) share[f].assign(finer[f].size(), 1.0);
  std::vector<std::pair<int, std::size_t>> folding;
  const auto mark = [&](int face, int i, int j) {
    folding.emplace_back(face, index(n_, i, j));
    const std::array<int, 3> weight = {n_ - i - j, i, j};
    for (int k = 0; k < 3; ++k) {
      const int twin = base_.twins[3 * face + k];
      if (weight[(k + 2) % 3] != 0 || weight[k] == 0 || weight[(k + 1) % 3] == 0 || twin < 0) continue;
      std::array<int, 3> there{};
      there[twin % 3] = weight[(k + 1) % 3];
      there[(twin % 3 + 1) % 3] = weight[k];
      folding.emplace_back(twin / 3, index(n_, there[1], there[2]));
    }
  };
  const auto area = [&](const Grid& grid, const std::array<int, 3>& i, const std::array<int, 3>& j) {
    return chart_area(grid[index(n_, i[0], j[0])], grid[index(n_, i[1], j[1])], grid[index(n_, i[2], j[2])]);
  };
  do {
    folding.clear();
    for (int f = 0; f < base_.face_count(); ++f)
      for_each_grid_triangle(f, n_, [&](const GridTriangle& triangle) {
        const DyadicTriangle t = triangle.corners();
        if (area(finer[f], t.i, t.j) > kLeastShare * area(straight[f], t.i, t.j)) return;
        for (int k = 0; k < 3; ++k) mark(f, t.i[k], t.j[k]);
      });
    std::sort(folding.begin(), folding.end());
    folding.erase(std::unique(folding.begin(), folding.end()), folding.end());
    bool moved = false;
    for (const auto& [f, at] : folding) {
      double& step = share[f][at];
      if (step == 0.0) continue;
      moved = true;
      shortened_ += step == 1.0;
      step = step > kShortest ? 0.5 * step : 0.0;
      finer[f][at] = straight[f][at] + step * (loop[f][at] - straight[f][at]);
    }
    if (!moved) break;
  } while (!folding.empty());
}

Complex SmoothedDomain::loop_point(int face, int i, int j) const {
  return i % 2 == 0 && j % 2 == 0 ? even_point(face, i / 2, j / 2) : odd_point(face, i, j);
}

/// Subdivision without Loop's step.
Complex SmoothedDomain::straight_point(int face, int i, int j) const {
  const bool falling = i % 2 != 0 && j % 2 != 0;  // on an edge from (i, j+1)/2 to (i+1, j)/2
  const Complex a = at(face, i / 2, falling ? (j + 1) / 2 : j / 2);
  const Complex b = at(face, (i + 1) / 2, falling ? j / 2 : (j + 1) / 2);
  return 0.5 * (a + b);
}

Complex SmoothedDomain::even_point(int face, int i, int j) const {
  const std::array<int, 3> weight = {n_ - i - j, i, j};
  const Complex here = at(face, i, j);
  for (int k = 0; k < 3; ++k)
    if (weight[k] == n_) return here;  // a base vertex
  for (int k = 0; k < 3; ++k) {
    if (weight[(k + 2) % 3] != 0) continue;
    const int along = weight[(k + 1) % 3];
    const Complex line = at_edge(face, k, along - 1, 0) + at_edge(face, k, along + 1, 0);
    if (base_.twins[3 * face + k] < 0) return 0.75 * here + 0.125 * line;
    const int back = n_ - along;
    return 0.625 * here + 0.0625 * (line + at_edge(face, k, along - 1, 1) + at_edge(face, k, along, 1) +
                                    behind_edge(face, k, back - 1, 1) + behind_edge(face, k, back, 1));
  }
  return 0.625 * here + 0.0625 * (at(face, i + 1, j) + at(face, i - 1, j) + at(face, i, j + 1) + at(face, i, j - 1) +
                                  at(face, i + 1, j - 1) + at(face, i - 1, j + 1));
}

Complex SmoothedDomain::odd_point(int face, int i, int j) const {
  const std::array<int, 3> weight = {2 * n_ - i - j, i, j};
  for (int k = 0; k < 3; ++k) {
    if (weight[(k + 2) % 3] != 0) continue;  // on base edge k
    const int along = (weight[(k + 1) % 3] - 1) / 2;
    const Complex ends = at_edge(face, k, along, 0) + at_edge(face, k, along + 1, 0);
    if (base_.twins[3 * face + k] < 0) return 0.5 * ends;
    return 0.375 * ends + 0.125 * (at_edge(face, k, along, 1) + behind_edge(face, k, n_ - along - 1, 1));
  }
  // The two ends differ from (i, j)/2 by half a step along the edge's direction; the two wings by the other two corners
  // of the triangles beside it.
  if (j % 2 == 0) {
    const int a = (i - 1) / 2, b = j / 2;
    return 0.375 * (at(face, a, b) + at(face, a + 1, b)) + 0.125 * (at(face, a, b + 1) + at(face, a + 1, b - 1));
  }
  if (i % 2 == 0) {
    const int a = i / 2, b = (j - 1) / 2;
    return 0.375 * (at(face, a, b) + at(face, a, b + 1)) + 0.125 * (at(face, a + 1, b) + at(face, a - 1, b + 1));
  }
  const int a = (i - 1) / 2, b = (j - 1) / 2;
  return 0.375 * (at(face, a + 1, b) + at(face, a, b + 1)) + 0.125 * (at(face, a, b) + at(face, a + 1, b + 1));
}

}  // namespace gsp
