#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/nearest/point_triangle.h"

namespace gsp {

/// Points that `TriangleTree::nearest` takes at once, to share one walk through the tree.
inline constexpr int kGroupSize = 8;

/// Bounding volume hierarchy over the triangles of a mesh: a complete tree of sixteen children a node over triangles
/// sorted by median splits, so that positions stand for pointers. Boxes are kept in float, in coordinates scaled to
/// [-1, 1] and rounded outward, so a box never hides a nearer triangle; triangles are kept in double. About 140 bytes a
/// triangle. O(F log F) to build, on all threads.
class TriangleTree {
 public:
  /// Throws the errors of `require_finite_surface`.
  explicit TriangleTree(const Mesh& mesh);
  /// In the order of another tree, with boxes of its own: O(F), two fifths of the time. Distances are those of any
  /// tree; finding them is as fast where the faces lie beside each other as there, as in decoded prefixes of one
  /// stream. Throws Error(BadOption) where the numbers of faces differ, and the errors of `require_finite_surface`.
  TriangleTree(const Mesh& mesh, const TriangleTree& like);

  /// #F, the faces in the tree's order, which keeps neighbours in space together.
  const std::vector<int>& order() const { return order_; }
  /// Place of a face in that order.
  int place(int face) const { return place_[face]; }
  /// #F, the faces' areas in the tree's order.
  const std::vector<double>& areas() const { return areas_; }
  /// Longest edge of the triangle at a place.
  double size(int place) const { return frames_[place].length; }

  /// squared[i] = squared distance of point i to the surface. `hint` is a place in the order to start from (any valid
  /// one gives the same distances) and receives the nearest one of the last point.
  void nearest(const PointGroup<kGroupSize>& points, double* squared, int& hint) const;
  double nearest(const Vec3& point, int& hint) const;

  /// Squared distance of a point to the triangle at a place.
  double squared_distance(int place, const Vec3& point) const;
  /// Squared distance of a point to the plane of the triangle at a place; to its line or point where it has no area.
  double squared_plane_distance(int place, const Vec3& point) const;

  /// A place near the point, for a first hint. O(log F).
  int descend(const Vec3& point) const;

 private:
  static constexpr int kWidth = 16;
  /// Boxes of the children, coordinate by coordinate; children that do not exist are infinitely far.
  struct alignas(64) Node {
    float low[3][kWidth], high[3][kWidth];
  };
  struct QueryBox {
    float low[3], high[3];
  };

  /// Where scaled coordinates are 0 and what 1 is.
  void set_scale(const Mesh& mesh);
  void sort_places(const Mesh& mesh);
  void build_frames(const Mesh& mesh);
  void build_boxes(const Mesh& mesh);
  float scaled(double value, int axis) const;
  template <int G>
  QueryBox query_box(const PointGroup<G>& points) const;
  template <int G>
  float bound(const double* squared) const;
  static void distances(const Node& node, const QueryBox& box, float* squared);
  /// The same, and the children that are at most `limit` away, a bit each.
  static std::uint32_t within(const Node& node, const QueryBox& box, float limit, float* squared);
  template <int G>
  void search(const PointGroup<G>& points, double* squared, int& hint) const;

  std::vector<int> order_, place_;
  std::vector<double> areas_;              ///< in the tree's order
  std::vector<TriangleFrame> frames_;      ///< in the tree's order
  std::vector<std::vector<Node>> levels_;  ///< levels_[0] holds the triangles' boxes; the last has one node
  Vec3 centre_ = Vec3::Zero();
  double scale_ = 1.0;
};

/// squared[i] = squared distance of each of `count` >= 1 points to the surface. Fast where the points follow each other
/// closely: they are asked in groups as long as a group stays about as small as the triangle it is near, so one walk
/// through the tree serves up to eight points, and where points are farther apart than the triangles each gets its own.
void squared_distances(const TriangleTree& target, const Vec3* points, std::size_t count, double* squared);

}  // namespace gsp
