#include "param/baselines/maps_smoothing.h"

#include <algorithm>
#include <cmath>

#include "param/removal/flatten.h"

namespace gsp {

namespace {

constexpr int kMostLevels = 8;
constexpr double kRounding = 1e-9;
constexpr int kLongestWalk = 4096;

/// z -> turn·z + shift, a rigid motion of the plane.
struct Motion {
  Complex turn = 1.0, shift = 0.0;
  Complex apply(Complex z) const { return turn * z + shift; }
};

/// Base triangles laid into the plane with their true side lengths, and the dyadic points of each as Loop moves them.
class SmoothedDomain {
 public:
  explicit SmoothedDomain(const Atlas& atlas) : atlas_(atlas), base_(atlas.base) {
    lay_out();
    for (const auto& corners : planes_) grids_.push_back({corners[0], corners[1], corners[2]});
    const double per_face = double(atlas.surface->mesh.face_count()) / base_.face_count();
    const int levels = std::clamp(static_cast<int>(std::ceil(std::log2(per_face) / 2.0)) + 1, 1, kMostLevels);
    for (int level = 0; level < levels; ++level) subdivide();
  }

  /// Gives the vertex the location t with L(t) = its initial one.
  void move(Atlas& atlas, int vertex) const;

 private:
  void lay_out();
  void subdivide();
  Complex new_point(int face, int i, int j) const;
  Complex even_point(int face, int i, int j) const;
  Complex odd_point(int face, int i, int j) const;

  /// Dyadic point with weights (n-i-j, i, j)/n for the corners 0, 1, 2; rows of constant j.
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * (n_ + 1) - j * (j - 1) / 2 + i; }
  Complex at(int face, int i, int j) const { return grids_[face][index(i, j)]; }
  /// The point `depth` rows inside edge k, `along` steps from corner k.
  Complex at_edge(int face, int k, int along, int depth) const {
    int weight[3];
    weight[k] = n_ - along - depth;
    weight[(k + 1) % 3] = along;
    weight[(k + 2) % 3] = depth;
    return at(face, weight[1], weight[2]);
  }
  /// The same behind edge k of the face, seen in the face's plane; `along` counts from the face's corner k + 1.
  Complex behind_edge(int face, int k, int along, int depth) const {
    const int twin = base_.twins[3 * face + k];
    return unfold_[3 * face + k].apply(at_edge(twin / 3, twin % 3, along, depth));
  }

  const Atlas& atlas_;
  const BaseComplex& base_;
  std::vector<std::array<Complex, 3>> planes_;  ///< corners of each base triangle in its own plane
  std::vector<Motion> unfold_;                  ///< per half-edge, the neighbour's plane into this face's plane
  std::vector<std::vector<Complex>> grids_;
  int n_ = 1;
};

void SmoothedDomain::lay_out() {
  const auto& positions = atlas_.surface->mesh.positions;
  for (const Triangle& t : base_.faces) {
    const Vec3 p[3] = {positions[base_.vertices[t[0]]], positions[base_.vertices[t[1]]],
                       positions[base_.vertices[t[2]]]};
    const double side = std::max((p[1] - p[0]).norm(), 1e-12);
    const double along = (p[1] - p[0]).dot(p[2] - p[0]) / side;
    const double height = std::sqrt(std::max((p[2] - p[0]).squaredNorm() - along * along, 0.0));
    // A base triangle without height would have no inside to walk in.
    planes_.push_back({0.0, side, Complex(along, std::max(height, 1e-3 * side))});
  }
  unfold_.resize(base_.twins.size());
  for (std::size_t h = 0; h < base_.twins.size(); ++h) {
    const int twin = base_.twins[h];
    if (twin < 0) continue;
    const auto &here = planes_[h / 3], &there = planes_[twin / 3];
    const Complex from = here[h % 3], to = here[(h % 3 + 1) % 3];
    const Complex there_from = there[(twin % 3 + 1) % 3], there_to = there[twin % 3];
    const Complex turn = (to - from) / (there_to - there_from);
    unfold_[h] = {turn, from - turn * there_from};
  }
}

void SmoothedDomain::subdivide() {
  std::vector<std::vector<Complex>> finer(grids_.size());
  for (int f = 0; f < base_.face_count(); ++f)
    for (int j = 0; j <= 2 * n_; ++j)
      for (int i = 0; i + j <= 2 * n_; ++i) finer[f].push_back(new_point(f, i, j));
  grids_ = std::move(finer);
  n_ *= 2;
}

Complex SmoothedDomain::new_point(int face, int i, int j) const {
  return i % 2 == 0 && j % 2 == 0 ? even_point(face, i / 2, j / 2) : odd_point(face, i, j);
}

Complex SmoothedDomain::even_point(int face, int i, int j) const {
  const int weight[3] = {n_ - i - j, i, j};
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
  const int weight[3] = {2 * n_ - i - j, i, j};
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

void SmoothedDomain::move(Atlas& atlas, int vertex) const {
  const auto start = chart_barycentric(atlas.position[vertex]);
  int face = atlas.patch[vertex];
  const auto& plane = planes_[face];
  Complex target = start[0] * plane[0] + start[1] * plane[1] + start[2] * plane[2];
  Transition change;

  // Walk over the dyadic triangles from the one where the vertex would be without smoothing. A triangle is the lower
  // left corner (i, j) of its cell and whether it is the upper half.
  int i = std::clamp(static_cast<int>(start[1] * n_), 0, n_ - 1);
  int j = std::clamp(static_cast<int>(start[2] * n_), 0, n_ - 1 - i);
  bool upper = i + j < n_ - 1 && (start[1] * n_ - i) + (start[2] * n_ - j) > 1.0;
  double best = -1e300;
  int best_face = face;
  Complex best_position = atlas.position[vertex];
  Transition best_change;
  for (int step = 0; step < kLongestWalk; ++step) {
    // Corners in the order (corner 0 side, corner 1 side, corner 2 side).
    const int ci[3] = {upper ? i + 1 : i, upper ? i : i + 1, upper ? i + 1 : i};
    const int cj[3] = {j, upper ? j + 1 : j, j + 1};
    const auto w = barycentric(target, at(face, ci[0], cj[0]), at(face, ci[1], cj[1]), at(face, ci[2], cj[2]));
    const int worst = static_cast<int>(std::min_element(w.begin(), w.end()) - w.begin());
    if (w[worst] > best) {
      best = w[worst];
      best_face = face;
      best_change = change;
      const double u1 = (w[0] * ci[0] + w[1] * ci[1] + w[2] * ci[2]) / n_;
      const double u2 = (w[0] * cj[0] + w[1] * cj[1] + w[2] * cj[2]) / n_;
      best_position = chart_position(1.0 - u1 - u2, u1);
    }
    if (w[worst] >= 0.0) break;
    if (upper) {  // corners (i+1,j), (i,j+1), (i+1,j+1)
      if (worst == 0) ++j;
      if (worst == 1) ++i;
      upper = false;
      continue;
    }
    // Lower triangle: behind corner 0 lies the upper half of the cell or, on the border, base edge 1.
    const bool border = worst == 0 ? i + j == n_ - 1 : worst == 1 ? i == 0 : j == 0;
    if (!border) {
      upper = true;
      if (worst == 1) --i;
      if (worst == 2) --j;
      continue;
    }
    const int k = (worst + 1) % 3, h = 3 * face + k, twin = base_.twins[h];
    if (twin < 0) break;
    const int weight[3] = {n_ - 1 - i - j, i, j};
    const int along = weight[(k + 1) % 3];
    const Motion& unfold = unfold_[h];
    target = (target - unfold.shift) / unfold.turn;
    change = base_.across(h) * change;
    face = twin / 3;
    int there[3];
    there[twin % 3] = along;
    there[(twin % 3 + 1) % 3] = n_ - 1 - along;
    there[(twin % 3 + 2) % 3] = 0;
    i = there[1];
    j = there[2];
  }
  // Around folds of the domain no triangle may hold the target: a position beyond one could lie anywhere.
  if (best < -kRounding) return;
  if (!best_change.is_identity() || best_face != atlas.patch[vertex])
    atlas.change_chart(vertex, best_face, best_change);
  atlas.position[vertex] = best_position;
}

}  // namespace

void smooth_by_loop(Atlas& atlas, Progress& progress) {
  progress.report("smooth by Loop", 0.0);
  const SmoothedDomain domain(atlas);
  for (int v = 0; v < atlas.surface->mesh.vertex_count(); ++v)
    if (atlas.patch[v] >= 0 && atlas.corner[v] < 0) domain.move(atlas, v);
  progress.report("smooth by Loop", 1.0);
}

}  // namespace gsp
