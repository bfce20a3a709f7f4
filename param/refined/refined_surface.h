#pragma once

#include <array>
#include <memory>
#include <vector>

#include "param/atlas/surface.h"
#include "param/atlas/triangle_links.h"
#include "param/map/lattice.h"

namespace gsp {

/// A surface that is cut finer and coarser again while it stays the same set of points: every vertex knows on which
/// vertex, edge or face of the original surface it lies, every face in which original face. Original vertices keep
/// their numbers, added ones come after them and never lie on a boundary.
class RefinedSurface {
 public:
  /// A place in a face of the original surface: the weights of its corners, on its border where one is exactly 0.
  struct Point {
    int face;
    std::array<double, 3> weights;
  };

  explicit RefinedSurface(std::shared_ptr<const Surface> original);
  /// One that is cut already. `origin`: per face of `links`. `added`: the places of its further vertices.
  RefinedSurface(std::shared_ptr<const Surface> original, TriangleLinks links, std::vector<int> origin,
                 const std::vector<Point>& added);

  const Surface& original() const { return *original_; }
  int vertex_count() const { return static_cast<int>(support_.size()); }
  bool added(int v) const { return v >= original_->mesh.vertex_count(); }
  int face_slots() const { return static_cast<int>(links_.faces.size()); }
  bool alive(int face) const { return links_.alive(face); }
  const Triangle& corners(int face) const { return links_.faces[face]; }
  /// The face of the original surface that a face is a piece of.
  int origin(int face) const { return origin_[face]; }
  /// Where a vertex lies in a face of the original surface that holds it: the weights of its corners.
  std::array<double, 3> weights_in(int v, int original_face) const;
  int from(int h) const { return links_.from(h); }
  int to(int h) const { return links_.to(h); }
  int twin(int h) const { return links_.twin[h]; }

  /// Calls visit(h) for the half-edges that leave v, counter-clockwise. The last neighbour of a boundary vertex has
  /// none.
  template <class Visit>
  void for_each_outgoing(int v, Visit&& visit) const {
    links_.for_each_outgoing(v, boundary(v), visit);
  }

  /// Splits the edge of h, which has a twin, at the share 0 < share < 1 of the way from its start. Either face keeps
  /// the half at the start of its half-edge (h or its twin) and gives the other to a new face, the last two: first that
  /// of h. Returns the new vertex.
  int split(int h, double share);

  /// Puts a vertex inside a face, with the weights of the face's corners, all positive: the face keeps its first side,
  /// two new faces, the last two, get the others. Returns the new vertex.
  int insert(int face, const std::array<double, 3>& weights);

  /// What `split` may change in some faces, and at all vertices of them.
  class Snapshot;
  Snapshot snapshot(const std::vector<int>& faces, const std::vector<int>& vertices) const;
  /// Undoes all splits since the snapshot, which must have been of edges between its faces, or new ones in them.
  void restore(const Snapshot& snapshot);

  /// Whether the added vertex from(h) can be drawn along h onto to(h) so that the surface stays what it is.
  bool can_collapse(int h) const;
  /// Does so: the two faces beside h die, in the others around from(h) to(h) takes its place.
  void collapse(int h);

  /// `TriangleLinks::collapsible` among the half-edges that `can_collapse` allows.
  template <class Link>
  int collapsible(int v, Complex center, Link&& link) const {
    return links_.collapsible(v, center, link, [&](int h) { return can_collapse(h); });
  }

  const TriangleLinks& links() const { return links_; }

  struct Compact {
    Mesh mesh;  ///< the original's vertices, then the added ones; an original face's first piece in its place
    std::vector<int> vertex;    ///< per vertex here, its number there, -1 for those that were drawn onto others
    std::vector<int> halfedge;  ///< per half-edge there, its number here
  };
  Compact compact() const;

 private:
  struct Support {
    int edge = -1, face = -1;        ///< both -1 for an original vertex
    std::array<double, 2> weight{};  ///< share along the edge's direction; weights of the face's corners 1 and 2
  };

  Support support_of(const Point& at) const;
  bool boundary(int v) const { return !added(v) && original_->halfedges.boundary_vertex(v); }
  int add_vertex(const Point& at);

  std::shared_ptr<const Surface> original_;
  TriangleLinks links_;
  std::vector<int> origin_;  ///< per face
  std::vector<Support> support_;
};

class RefinedSurface::Snapshot {
  friend class RefinedSurface;
  std::vector<int> faces_, vertices_;
  std::vector<Triangle> corners_;  ///< per face of `faces_`
  std::vector<int> twin_;          ///< three per face
  std::vector<int> outgoing_;      ///< per vertex of `vertices_`
  int face_slots_ = 0, vertex_count_ = 0;
};

}  // namespace gsp
