#pragma once

#include <vector>

#include "param/reinsert/reinsertion_map.h"

namespace gsp {

/// The hole that a removed vertex left, in a map which has just those vertices that were left then: the pieces in the
/// triangles that fill it, and its border. Vectors are kept from hole to hole.
///
///        r2 ----- x ----- r1        r0 .. r3: the star's ring; x, y: vertices added to the map since
///        | \      |      / |
///        |   \    |    /   |        border: r0 -> r1, r1 -> x, x -> r2, r2 -> r3, r3 -> r0
///        |     \  |  /     |        side.halfedge: along it, of a face in the hole
///        |        y        |        side.slot: that of the star's triangle behind it, the same for r1 -> x and x -> r2
///        |     /     \     |        side_of_ring: 0, 1, 3, 4
///        |  /           \  |        region: the five faces around y, among which the centre is to come
///        r3 ------------- r0
///
/// Around a boundary vertex the outline is a chain; its last side, from the ring's last vertex to its first, has no
/// half-edge until the centre lies on it.
class StarHole {
 public:
  /// One side of the hole, between two vertices that follow on its border.
  struct Side {
    int vertex;    ///< where it starts
    int halfedge;  ///< inside; -1 for the end of a boundary star's chain
    int slot;      ///< the star's triangle behind it
  };

  explicit StarHole(ReinsertionMap& growing) : map(growing) {}

  /// Finds the hole of a removal. False where its border is not in the map.
  bool open(int removal);
  bool holds(int face) const { return face < static_cast<int>(in_region_.size()) && in_region_[face] == stamp_; }
  bool is_side(int h) const { return h < static_cast<int>(is_side_.size()) && is_side_[h] == stamp_; }
  /// The faces made since, all in the hole, come to the region.
  void take_new_faces();
  /// Where a vertex of the hole lies in the plane of the star.
  Complex in_plane(int v) const;
  /// Of a boundary star: where the centre lies on the way from the end of the ring to its start.
  double share_of_boundary() const { return -ring.back().real() / (ring.front().real() - ring.back().real()); }
  /// All faces up to so many rings around the hole, ascending; but no ring goes on around a vertex in the middle of a
  /// large fan, whose faces would be gathered again for every hole beside it.
  std::vector<int> faces_within(int rings) const;

  ReinsertionMap& map;
  Star star;                          ///< as it was, and is to be again
  std::vector<RingTriangle> filling;  ///< of the hole
  std::vector<Complex> ring;          ///< `flatten_star` of the star
  std::vector<Side> border;
  std::vector<int> side_of_ring;  ///< per ring vertex, the side that starts there
  std::vector<int> region;        ///< the faces in the hole

 private:
  bool find_border();
  int toward(int at, int a, int b) const;
  void fill_region();

  int stamp_ = 0;
  std::vector<int> in_region_, is_side_;  ///< per face and per half-edge, the stamp of the last hole it was so
};

}  // namespace gsp
