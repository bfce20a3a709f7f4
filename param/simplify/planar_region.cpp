#include "param/simplify/planar_region.h"

#include <algorithm>

namespace gsp {

namespace {

constexpr double kSnap = 0.2;  // of a crossed edge, within which its end is moved onto the cut instead
constexpr double kSmall =
    1e-8;  // area of a piece in the plane, the region's radius being 1, below which it is made larger
constexpr double kLightCorner = 0.05;  // weight of a corner below which a new vertex goes onto the opposite side
constexpr int kRelaxations = 3;
constexpr double kGain = 1.01;
constexpr int kLongestCut = 1 << 20;

double quality(Complex a, Complex b, Complex c) {
  const double thick = thickness(a, b, c);
  return thick > 0.0 ? std::min(1.0, chart_area(a, b, c) / kSmall) * std::min(1.0, thick / kThin) : thick;
}

}  // namespace

void PlanarRegion::begin(const std::vector<int>& faces) {
  faces_ = faces;
  // A region that was taken back has left longer ones behind.
  inside_.resize(refined_.face_slots(), 0);
  for (int f : faces_) inside_[f] = 1;
  const std::size_t count = refined_.vertex_count();
  flat_.resize(count);
  in_region_.resize(count, 0);
  hold_.resize(count, Hold::Free);
  line_.resize(count);
  vertices_.clear();
  for (int f : faces_)
    for (int v : refined_.corners(f)) {
      if (in_region_[v]) continue;
      in_region_[v] = 1;
      vertices_.push_back(v);
    }
}

void PlanarRegion::leave() {
  for (int f : faces_) inside_[f] = 0;
  for (int v : vertices_) in_region_[v] = 0;
}

double PlanarRegion::area(int face) const {
  const Triangle& t = refined_.corners(face);
  return chart_area(flat_[t[0]], flat_[t[1]], flat_[t[2]]);
}

double PlanarRegion::share_on_line(int v, Complex at) const {
  const Complex a = flat_[line_[v].first], b = flat_[line_[v].second];
  return std::real((at - a) / (b - a));
}

/// Takes a vertex that the surface has just got, at a place, and the faces that came with it.
int PlanarRegion::added(int v, Complex at) {
  for (int f = static_cast<int>(inside_.size()); f < refined_.face_slots(); ++f) {
    faces_.push_back(f);
    inside_.push_back(1);
  }
  flat_.push_back(at);
  in_region_.push_back(1);
  hold_.push_back(Hold::Free);
  line_.emplace_back();
  vertices_.push_back(v);
  return v;
}

bool PlanarRegion::movable(int v) const {
  return hold_[v] == Hold::Free && (refined_.added(v) || !refined_.original().halfedges.boundary_vertex(v));
}

/// Moves a vertex to a place at a share of the length of one of its edges, if that spoils no piece: the nearer, the
/// worse would be the slivers beside the vertex where it was.
bool PlanarRegion::move_to(int v, Complex to, double share) {
  if (share > kSnap || !movable(v)) return false;
  bool possible = true;
  refined_.for_each_outgoing(v, [&](int h) {
    const Complex x = flat_[refined_.to(h)], y = flat_[refined_.from(Halfedges::prev(h))];
    possible = possible && thickness(to, x, y) > std::min(kThin, kWorse * share / kSnap * thickness(flat_[v], x, y));
  });
  if (possible) flat_[v] = to;
  return possible;
}

/// The vertex after `at` on the cut toward the target, which is added, or moved there, where there is none; -1 where
/// the pieces in its way have no area to cut.
int PlanarRegion::next_on_cut(int at, int target) {
  const Complex direction = flat_[target] - flat_[at];
  int crossed = -1;
  bool found = false;
  double share = 0.0;
  refined_.for_each_outgoing(at, [&](int h) {
    if (found || !holds_face(h / 3)) return;
    const int p = refined_.to(h), q = refined_.from(Halfedges::prev(h));
    found = p == target || q == target;
    if (found || crossed >= 0) return;
    const double right = cross(direction, flat_[p] - flat_[at]), left = cross(direction, flat_[q] - flat_[at]);
    if (right > 0.0 || left <= 0.0) return;
    crossed = Halfedges::next(h);
    share = right / (right - left);
  });
  if (found) return target;
  if (crossed < 0 || refined_.twin(crossed) < 0 || !holds_face(refined_.twin(crossed) / 3)) return -1;
  const int p = refined_.from(crossed), q = refined_.to(crossed);
  const Complex at_cut = (1.0 - share) * flat_[p] + share * flat_[q];
  if (move_to(p, at_cut, share)) return p;
  if (move_to(q, at_cut, 1.0 - share)) return q;
  return share > 0.0 && share < 1.0 ? added(refined_.split(crossed, share), at_cut) : -1;
}

bool PlanarRegion::cut(int start, int end) {
  int at = start;
  for (int step = 0; step < kLongestCut; ++step) {
    at = next_on_cut(at, end);
    if (at == end) return true;
    if (at < 0) return false;
    put_on(at, {start, end});
  }
  return false;
}

int PlanarRegion::insert(Complex at) {
  for (int f : faces_) {
    const Triangle t = refined_.corners(f);
    const double whole = area(f);
    double w[3];
    for (int k = 0; k < 3; ++k) w[k] = chart_area(at, flat_[t[(k + 1) % 3]], flat_[t[(k + 2) % 3]]) / whole;
    const int least = static_cast<int>(std::min_element(w, w + 3) - w);
    if (!(whole > 0.0) || w[least] < 0.0) continue;
    int made = -1;
    for (int k = 0; k < 3 && made < 0; ++k)
      if (move_to(t[k], at, 1.0 - w[k])) made = t[k];
    // Beside a side the vertex goes onto it where the pieces behind stay upright, so that none is a sliver.
    const int side = 3 * f + (least + 1) % 3, twin = refined_.twin(side);
    if (made < 0 && w[least] < kLightCorner && twin >= 0 && holds_face(twin / 3)) {
      const Complex from = flat_[refined_.from(side)], to = flat_[refined_.to(side)],
                    behind = flat_[refined_.from(Halfedges::prev(twin))];
      const double share = w[(least + 2) % 3] / (1.0 - w[least]);
      if (thickness(from, behind, at) > kThin && thickness(at, behind, to) > kThin && share > 0.0 && share < 1.0)
        made = added(refined_.split(side, share), at);
    }
    if (made < 0) made = added(refined_.insert(f, {w[0], w[1], w[2]}), at);
    hold_[made] = Hold::Ring;
    return made;
  }
  return -1;
}

/// The least quality of the pieces around v, were it at a place.
double PlanarRegion::least_quality(int v, Complex at) const {
  double least = 1.0;
  refined_.for_each_outgoing(v, [&](int h) {
    least = std::min(least, quality(at, flat_[refined_.to(h)], flat_[refined_.from(Halfedges::prev(h))]));
  });
  return least;
}

void PlanarRegion::relax() {
  moving_.clear();
  for (int f : faces_) {
    const Triangle& t = refined_.corners(f);
    if (quality(flat_[t[0]], flat_[t[1]], flat_[t[2]]) >= 1.0) continue;
    for (int v : t)
      if (hold_[v] != Hold::Ring) moving_.push_back(v);
  }
  std::sort(moving_.begin(), moving_.end());
  moving_.erase(std::unique(moving_.begin(), moving_.end()), moving_.end());
  for (int pass = 0; pass < kRelaxations && !moving_.empty(); ++pass) {
    const auto left = std::remove_if(moving_.begin(), moving_.end(), [&](int v) { return !relax(v); });
    moving_.erase(left, moving_.end());
  }
}

bool PlanarRegion::relax(int v) {
  if (hold_[v] == Hold::Free && !movable(v)) return false;
  Complex middle = 0.0;
  int neighbours = 0;
  refined_.for_each_outgoing(v, [&](int h) {
    middle += flat_[refined_.to(h)];
    ++neighbours;
  });
  middle /= neighbours;
  if (hold_[v] == Hold::Edge) {  // along its edge only
    const Complex a = flat_[line_[v].first], b = flat_[line_[v].second];
    middle = a + share_on_line(v, middle) * (b - a);
  }
  const double before = least_quality(v, flat_[v]);
  for (double step = 1.0; step > 0.1; step *= 0.5) {
    const Complex at = flat_[v] + step * (middle - flat_[v]);
    if (least_quality(v, at) <= std::max(0.0, kGain * before)) continue;
    flat_[v] = at;
    return true;
  }
  return false;
}

void PlanarRegion::take_out() {
  for (int v : vertices_) {
    if (!refined_.added(v) || hold_[v] != Hold::Free) continue;
    const auto link = [&](int out) {
      return std::pair(flat_[refined_.to(out)], flat_[refined_.from(Halfedges::prev(out))]);
    };
    const int along = refined_.collapsible(v, flat_[v], link);
    if (along >= 0) refined_.collapse(along);
  }
}

}  // namespace gsp
