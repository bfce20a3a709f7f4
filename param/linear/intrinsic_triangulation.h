#pragma once

#include <vector>

#include "param/atlas/surface.h"
#include "param/map/lattice.h"

namespace gsp {

/// Some faces of a surface as a triangulation that knows its edge lengths alone, so that an edge can be flipped without
/// leaving the surface (Bobenko, Springborn 2007). Edges may join a vertex to itself, or two vertices more than once.
class IntrinsicTriangulation {
 public:
  struct Halfedge {
    int from;  ///< vertex of the surface
    int twin;  ///< -1 on the border
    double length;
    Transition towards;  ///< from the chart of the vertex it leads to, to that of the vertex it leaves
  };

  /// `faces`: distinct, ascending. All lengths are raised by so little that no face is without area (Sharp, Crane
  /// 2020). Transitions are the identity.
  IntrinsicTriangulation(const Surface& surface, const std::vector<int>& faces);

  /// Corner k of the i-th face is where half-edge 3i + k starts.
  std::vector<Halfedge>& halfedges() { return halfedges_; }
  const std::vector<Halfedge>& halfedges() const { return halfedges_; }

  /// Flips edges until none is left whose opposite angles sum to more than π. The transition of a new edge is composed
  /// of those past an end of the old one that is no patch corner (`corner`: #V of the surface, -1 where there is none),
  /// since at corners transitions hold up to turns only. An edge between two corners stays.
  void make_delaunay(const std::vector<int>& corner);

  /// Half the cotangent of the angle opposite to a half-edge.
  double half_cotangent(int h) const;

 private:
  bool wants_flip(int h) const;
  void flip(int h, bool past_start);

  std::vector<Halfedge> halfedges_;
};

}  // namespace gsp
