#include "param/linear/intrinsic_triangulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

namespace gsp {

namespace {

constexpr double kLeastExcess = 1e-5;  // of the mean length: by how much two sides exceed the third at least
constexpr double kCocircular = 1e-9;   // sums of cotangents that are negative by less are rounding
constexpr int kMostFlips = 100;        // per edge, where rounding would go round in circles

}  // namespace

IntrinsicTriangulation::IntrinsicTriangulation(const Surface& surface, const std::vector<int>& faces) {
  assert(std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<>()) == faces.end());
  const auto& p = surface.mesh.positions;
  double total = 0.0;
  for (int f : faces)
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * f + k, twin = surface.halfedges.twin[h];
      const auto at = std::lower_bound(faces.begin(), faces.end(), twin / 3);
      const bool here = twin >= 0 && at != faces.end() && *at == twin / 3;
      const double length = (p[surface.halfedges.to(h)] - p[surface.halfedges.from(h)]).norm();
      halfedges_.push_back(
          {surface.halfedges.from(h), here ? 3 * static_cast<int>(at - faces.begin()) + twin % 3 : -1, length, {}});
      total += length;
    }
  const double least = halfedges_.empty() ? 0.0 : kLeastExcess * total / double(halfedges_.size());
  double missing = 0.0;
  for (int h = 0; h < static_cast<int>(halfedges_.size()); ++h)
    missing = std::max(missing, least - (halfedges_[Halfedges::next(h)].length + halfedges_[Halfedges::prev(h)].length -
                                         halfedges_[h].length));
  for (Halfedge& h : halfedges_) h.length += missing;
}

double IntrinsicTriangulation::half_cotangent(int h) const {
  double side[3] = {halfedges_[h].length, halfedges_[Halfedges::next(h)].length, halfedges_[Halfedges::prev(h)].length};
  const double cosine = side[1] * side[1] + side[2] * side[2] - side[0] * side[0];
  std::sort(side, side + 3);
  // Kahan's form of Heron's formula, exact to rounding for needles too.
  const double a = side[2], b = side[1], c = side[0];
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));  // 16 area²
  return 0.5 * cosine / std::sqrt(std::max(product, 1e-300));
}

bool IntrinsicTriangulation::wants_flip(int h) const {
  const int twin = halfedges_[h].twin;
  if (twin < 0 || twin / 3 == h / 3) return false;
  const double one = half_cotangent(h), other = half_cotangent(twin);
  return one + other < -kCocircular * (1.0 + std::abs(one) + std::abs(other));
}

void IntrinsicTriangulation::flip(int h, bool past_start) {
  const int t = halfedges_[h].twin;
  const int slot[4] = {Halfedges::next(h), Halfedges::prev(h), Halfedges::next(t), Halfedges::prev(t)};
  const Halfedge bc = halfedges_[slot[0]], ca = halfedges_[slot[1]], ad = halfedges_[slot[2]], db = halfedges_[slot[3]];
  // The diamond in the plane: a at 0, b on the axis, c above, d below.
  const double ab = halfedges_[h].length;
  const auto along = [&](double from_a, double from_b) {
    return (ab * ab + from_a * from_a - from_b * from_b) / (2.0 * ab);
  };
  const auto away = [](double from_a, double x) { return std::sqrt(std::max(from_a * from_a - x * x, 0.0)); };
  const double xc = along(ca.length, bc.length), xd = along(ad.length, db.length);
  const double length = std::hypot(xc - xd, away(ca.length, xc) + away(ad.length, xd));
  const Transition c_to_d = past_start ? ad.towards.inverse() * ca.towards.inverse() : db.towards * bc.towards;

  // Faces d c a and c d b; `slot[i]` moves to `target[i]`.
  const int target[4] = {slot[3], slot[0], slot[1], slot[2]};
  const Halfedge moved[4] = {bc, ca, ad, db};
  halfedges_[h] = {db.from, t, length, c_to_d};
  halfedges_[t] = {ca.from, h, length, c_to_d.inverse()};
  for (int i = 0; i < 4; ++i) halfedges_[target[i]] = moved[i];
  for (int i = 0; i < 4; ++i) {
    Halfedge& side = halfedges_[target[i]];
    const int* old = std::find(slot, slot + 4, side.twin);
    if (old != slot + 4)
      side.twin = target[old - slot];
    else if (side.twin >= 0)
      halfedges_[side.twin].twin = target[i];
  }
}

void IntrinsicTriangulation::make_delaunay(const std::vector<int>& corner) {
  std::vector<int> open;
  for (int h = static_cast<int>(halfedges_.size()) - 1; h >= 0; --h)
    if (halfedges_[h].twin > h) open.push_back(h);
  for (std::size_t left = kMostFlips * open.size(); !open.empty() && left > 0;) {
    const int h = open.back();
    open.pop_back();
    if (!wants_flip(h)) continue;
    const int t = halfedges_[h].twin;
    const bool past_start = corner[halfedges_[h].from] < 0;
    if (!past_start && corner[halfedges_[t].from] >= 0) continue;
    flip(h, past_start);
    --left;
    for (int side : {Halfedges::next(h), Halfedges::prev(h), Halfedges::next(t), Halfedges::prev(t)})
      open.push_back(side);
  }
}

}  // namespace gsp
