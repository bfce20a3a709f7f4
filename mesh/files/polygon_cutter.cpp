#include "mesh/files/polygon_cutter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "mesh/files/orientation.h"

namespace gsp {

namespace {

/// Rounding, a thousand units in the last place of 53 bits, relative to the coordinates or to what an area is a sum of.
constexpr double kNoArea = 1e-13;

int sign_of(double difference) { return (difference > 0.0) - (difference < 0.0); }

}  // namespace

PolygonCutter::Outcome PolygonCutter::cut(std::span<const Vec3> corners) {
  const int count = static_cast<int>(corners.size());
  triangles_.clear();
  if (count == 3) {
    triangles_.push_back({0, 1, 2});
    return Outcome::Cut;
  }
  const Shape shape = project(corners);
  if (shape == Shape::CrossesItself) return Outcome::NotSimple;
  if (shape == Shape::Line || fan_works()) {
    make_fan(count);
    return Outcome::Cut;
  }
  if (corners.size() > kMostCorners) return Outcome::TooManyCorners;
  link_corners();
  return is_simple() && cut_ears() ? Outcome::Cut : Outcome::NotSimple;
}

/// Along the normal onto the coordinate plane that it is nearest to. This differs from the plane across the normal by
/// an affine map, which changes neither what crosses nor what is convex, and it keeps coordinates of an axis-parallel
/// polygon as they are.
PolygonCutter::Shape PolygonCutter::project(std::span<const Vec3> corners) {
  double largest = 0.0;
  for (const Vec3& p : corners) {
    if (!p.allFinite()) return Shape::Line;
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  if (largest == 0.0) return Shape::Line;
  const int exponent = -std::ilogb(largest);  // by a power of two, so nothing is rounded
  const auto scaled = [&](const Vec3& p) -> Vec3 {
    return p.unaryExpr([&](double x) { return std::scalbn(x, exponent); });
  };
  const Vec3 origin = scaled(corners[0]);
  Vec3 normal = Vec3::Zero(), from_origin = Vec3::Zero();
  double areas = 0.0, reach = 0.0;
  for (const Vec3& p : corners) {
    const Vec3 next = scaled(p) - origin, area = from_origin.cross(next);
    normal += area;
    areas += area.norm();
    reach = std::max(reach, next.squaredNorm());
    from_origin = next;
  }
  if (areas <= kNoArea * std::sqrt(reach)) return Shape::Line;  // the largest coordinate is about 1
  if (normal.norm() <= kNoArea * areas) return Shape::CrossesItself;
  Eigen::Index along;
  normal.cwiseAbs().maxCoeff(&along);
  Eigen::Index x = (along + 1) % 3, y = (along + 2) % 3;
  if (normal[along] < 0.0) std::swap(x, y);
  const Point slope(normal[x] / normal[along], normal[y] / normal[along]);
  points_.clear();
  for (const Vec3& p : corners) {
    const Vec3 q = scaled(p);
    points_.push_back(Point(q[x], q[y]) - (q[along] - origin[along]) * slope);
  }
  return Shape::Flat;
}

int PolygonCutter::turn(int a, int b, int c) const { return orientation(points_[a], points_[b], points_[c]); }

/// All triangles run the right way round, and together less than once around corner 0.
bool PolygonCutter::fan_works() const {
  const int count = static_cast<int>(points_.size());
  bool behind = false;
  for (int k = 2; k < count; ++k) {
    if (turn(0, k - 1, k) <= 0) return false;
    const int side = turn(0, 1, k);
    if (side > 0 && behind) return false;
    behind = behind || side <= 0;
  }
  return true;
}

void PolygonCutter::make_fan(int corners) {
  for (int k = 2; k < corners; ++k) triangles_.push_back({0, k - 1, k});
}

/// Corners at the same place as the one before leave the ring with a triangle that has no area.
void PolygonCutter::link_corners() {
  left_ = static_cast<int>(points_.size());
  next_.resize(points_.size());
  previous_.resize(points_.size());
  for (int k = 0; k < left_; ++k) {
    next_[k] = (k + 1) % left_;
    previous_[(k + 1) % left_] = k;
  }
  const int count = left_;
  for (int k = 1; k < count; ++k)
    if (points_[previous_[k]] == points_[k] && left_ > 3) remove(k);
  if (points_[previous_[0]] == points_[0] && left_ > 3) remove(0);
  ring_.clear();
  for (int k = 0; k < count; ++k)
    if (next_[k] != k) ring_.push_back(k);
}

void PolygonCutter::remove(int corner) {
  const int a = previous_[corner], c = next_[corner];
  triangles_.push_back({a, corner, c});
  next_[a] = c;
  previous_[c] = a;
  next_[corner] = corner;
  --left_;
}

bool PolygonCutter::on_segment(int p, int a, int b) const {
  const auto between = [&](int k) {
    return std::min(points_[a][k], points_[b][k]) <= points_[p][k] &&
           points_[p][k] <= std::max(points_[a][k], points_[b][k]);
  };
  return between(0) && between(1) && turn(a, b, p) == 0;
}

/// Whether the edges that leave corners a and c do more than share an end, or the whole of a bridge.
bool PolygonCutter::edges_conflict(int a, int c) const {
  const int b = next_[a], d = next_[c];
  const auto same = [&](int p, int q) { return points_[p] == points_[q]; };
  const auto inside = [&](int p, int q, int r) { return !same(p, q) && !same(p, r) && on_segment(p, q, r); };
  if (same(a, c) && same(b, d)) return true;
  if (same(a, d) && same(b, c)) return b == c || d == a;  // there and straight back
  if (inside(a, c, d) || inside(b, c, d) || inside(c, a, b) || inside(d, a, b)) return true;
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// Edges are taken by their lower end in x, so that only those are compared whose extents in x overlap.
bool PolygonCutter::is_simple() {
  const auto low = [&](int e, int k) { return std::min(points_[e][k], points_[next_[e]][k]); };
  const auto high = [&](int e, int k) { return std::max(points_[e][k], points_[next_[e]][k]); };
  touches_itself_ = false;
  std::sort(ring_.begin(), ring_.end(),
            [&](int e, int f) { return low(e, 0) != low(f, 0) ? low(e, 0) < low(f, 0) : e < f; });
  for (std::size_t i = 0; i < ring_.size(); ++i)
    for (std::size_t j = i + 1; j < ring_.size() && low(ring_[j], 0) <= high(ring_[i], 0); ++j) {
      const int e = ring_[i], f = ring_[j];
      if (low(e, 1) > high(f, 1) || low(f, 1) > high(e, 1)) continue;
      if (edges_conflict(e, f)) return false;
      touches_itself_ = touches_itself_ || points_[e] == points_[f];
    }
  return turns_once();
}

/// Counts how often the direction of travel passes that of the x axis. A polygon that touches itself may go round twice
/// without an edge that crosses another.
bool PolygonCutter::turns_once() const {
  const auto upward = [&](int e) {
    const int dy = sign_of(points_[next_[e]].y() - points_[e].y());
    return dy > 0 || (dy == 0 && points_[next_[e]].x() > points_[e].x());
  };
  int turns = 0;
  for (const int e : ring_) {
    const int f = next_[e];
    if (upward(e) == upward(f)) continue;
    const int side = turn(e, f, next_[f]);
    if (side > 0 && upward(f)) ++turns;
    if (side < 0 && upward(e)) --turns;
  }
  return turns == 1;
}

/// Whether corner r keeps the triangle a, b, c from being cut off.
bool PolygonCutter::blocks(int r, int a, int b, int c) const {
  if (points_[r] == points_[a] || points_[r] == points_[c]) return false;
  if (points_[r] == points_[b]) {
    const auto in_wedge = [&](int p) { return turn(a, b, p) > 0 && turn(b, c, p) > 0; };
    return in_wedge(previous_[r]) || in_wedge(next_[r]);
  }
  return turn(a, b, r) >= 0 && turn(b, c, r) >= 0 && turn(c, a, r) >= 0;
}

bool PolygonCutter::is_ear(int b) const {
  const int a = previous_[b], c = next_[b];
  if (turn(a, b, c) <= 0) return false;
  const Point low = points_[a].cwiseMin(points_[b]).cwiseMin(points_[c]);
  const Point high = points_[a].cwiseMax(points_[b]).cwiseMax(points_[c]);
  for (const int r : candidates_) {
    if (r == a || r == b || r == c || next_[r] == r) continue;
    if ((points_[r].array() < low.array()).any() || (points_[r].array() > high.array()).any()) continue;
    if (blocks(r, a, b, c)) return false;
  }
  return true;
}

/// Where an ear is cut off, only the two corners beside it can become ears (O'Rourke, "Computational Geometry in C").
bool PolygonCutter::cut_ears() {
  // Among the corners in a triangle is one that is not convex, unless corners share a place.
  candidates_.clear();
  for (const int k : ring_)
    if (touches_itself_ || turn(previous_[k], k, next_[k]) <= 0) candidates_.push_back(k);
  queue_ = ring_;
  std::sort(queue_.begin(), queue_.end());
  for (std::size_t i = 0; i < queue_.size() && left_ > 3; ++i) {
    const int b = queue_[i];
    if (next_[b] == b || !is_ear(b)) continue;
    const int a = previous_[b], c = next_[b];
    remove(b);
    queue_.push_back(a);
    queue_.push_back(c);
  }
  if (left_ > 3) return false;
  const int last = *std::find_if(ring_.begin(), ring_.end(), [&](int k) { return next_[k] != k; });
  triangles_.push_back({previous_[last], last, next_[last]});
  return turn(previous_[last], last, next_[last]) > 0;
}

}  // namespace gsp
