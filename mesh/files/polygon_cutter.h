#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Cuts polygons into triangles. Buffers are kept from one to the next.
///
/// A polygon is seen along its normal, which is that of its vector area (Newell), so it need not be planar. There it
/// must be simple; it may touch itself where corners share a place, as one with a hole does that is joined to its
/// border by a bridge. Every triangle then runs the polygon's way round, and none overlaps another. A fan from corner 0
/// is taken where it does that, ears are cut elsewhere (Meisters, "Polygons have ears", 1975), with exact signs.
class PolygonCutter {
 public:
  /// Corners of a polygon that is no fan, at most: bounds the time of one to about a second.
  static constexpr std::size_t kMostCorners = 16384;

  enum class Outcome { Cut, NotSimple, TooManyCorners };

  /// `corners` are three at least. Polygons without area (all corners on a line) and those with a coordinate that is
  /// not finite become fans, for a report to name. O(n) for a fan, otherwise O(n²) at most.
  Outcome cut(std::span<const Vec3> corners);

  /// The n - 2 triangles of corner numbers, after Cut.
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  using Point = Eigen::Vector2d;
  enum class Shape { Flat, Line, CrossesItself };

  Shape project(std::span<const Vec3> corners);
  bool fan_works() const;
  void make_fan(int corners);
  void link_corners();
  bool is_simple();
  bool turns_once() const;
  bool edges_conflict(int a, int c) const;
  bool cut_ears();
  bool is_ear(int b) const;
  bool blocks(int r, int a, int b, int c) const;
  void remove(int corner);
  int turn(int a, int b, int c) const;
  bool on_segment(int p, int a, int b) const;

  std::vector<Point> points_;         ///< the corners, as seen along the normal
  std::vector<int> next_, previous_;  ///< the ring of corners that are left; a removed one is its own successor
  std::vector<int> ring_, candidates_, queue_;
  int left_ = 0;
  bool touches_itself_ = false;
  std::vector<Triangle> triangles_;
};

}  // namespace gsp
