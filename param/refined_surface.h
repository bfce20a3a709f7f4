#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "param/lattice.h"
#include "param/surface.h"

namespace gsp {

constexpr double kThin = 0.05;  ///< `thickness` below which a piece of a surface is not made,
constexpr double kWorse = 0.5;  ///< unless it becomes no thinner than this share of before

/// Height over longest side of a triangle in the plane; not positive where it is not upright.
inline double thickness(Complex a, Complex b, Complex c) {
  return cross(b - a, c - a) / std::max({std::norm(b - a), std::norm(c - b), std::norm(a - c), 1e-300});
}

/// A surface that is cut finer and coarser again while it stays the same set of points: every vertex knows on which vertex,
/// edge or face of the original surface it lies, every face in which original face. Original vertices keep their numbers,
/// added ones come after them and never lie on a boundary.
class RefinedSurface {
 public:
  explicit RefinedSurface(std::shared_ptr<const Surface> original);

  const Surface& original() const { return *original_; }
  int vertex_count() const { return static_cast<int>(support_.size()); }
  bool added(int v) const { return v >= original_->mesh.vertex_count(); }
  int face_slots() const { return static_cast<int>(faces_.size()); }
  bool alive(int face) const { return faces_[face][0] >= 0; }
  const Triangle& corners(int face) const { return faces_[face]; }
  /// The face of the original surface that a face is a piece of.
  int origin(int face) const { return origin_[face]; }
  /// Where a vertex lies in a face of the original surface that holds it: the weights of its corners.
  std::array<double, 3> weights_in(int v, int original_face) const;
  int from(int h) const { return faces_[h / 3][h % 3]; }
  int to(int h) const { return from(Halfedges::next(h)); }
  int twin(int h) const { return twin_[h]; }

  /// Calls visit(h) for the half-edges that leave v, counter-clockwise. The last neighbour of a boundary vertex has none.
  template <class Visit>
  void for_each_outgoing(int v, Visit&& visit) const {
    int h = outgoing_[v];
    if (h < 0) return;
    if (boundary(v))  // back to the first face of the fan
      while (twin_[h] >= 0) h = Halfedges::next(twin_[h]);
    const int start = h;
    do {
      visit(h);
      h = twin_[Halfedges::prev(h)];
    } while (h >= 0 && h != start);
  }

  /// Splits the edge of h, which has a twin, at the share 0 < share < 1 of the way from its start. Either face keeps the half
  /// at the start of its half-edge (h or its twin) and gives the other to a new face, the last two: first that of h.
  /// Returns the new vertex.
  int split(int h, double share);

  /// Puts a vertex inside a face, with the weights of the face's corners, all positive: the face keeps its first side, two new
  /// faces, the last two, get the others. Returns the new vertex.
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

  /// A half-edge along which v can be collapsed such that a map into the plane stays upright, its pieces thick enough or
  /// hardly thinner than before; -1 where there is none. v lies at `center`, and link(out) gives the two other corners, in
  /// order, of the face of a half-edge `out` that leaves it.
  template <class Link>
  int collapsible(int v, Complex center, Link&& link) const {
    double before = 1.0;
    for_each_outgoing(v, [&](int h) {
      const auto [x, y] = link(h);
      before = std::min(before, thickness(center, x, y));
    });
    const double least = std::min(kThin, kWorse * before);
    int along = -1;
    for_each_outgoing(v, [&](int h) {
      if (along < 0 && draws_well(h, least, link) && can_collapse(h)) along = h;
    });
    return along;
  }

  struct Compact {
    Mesh mesh;                 ///< the original's vertices, then the added ones; an original face's first piece in its place
    std::vector<int> vertex;   ///< per vertex here, its number there, -1 for those that were drawn onto others
    std::vector<int> halfedge; ///< per half-edge there, its number here
  };
  Compact compact() const;

 private:
  struct Support {
    int edge = -1, face = -1;      ///< both -1 for an original vertex
    std::array<double, 2> weight{};  ///< share along the edge's direction; weights of the face's corners 1 and 2
  };

  template <class Link>
  bool draws_well(int h, double least, Link&& link) const {
    const int n = to(h);
    bool well = true;
    const Complex goal = link(h).first;
    for_each_outgoing(from(h), [&](int out) {
      if (!well || to(out) == n || from(Halfedges::prev(out)) == n) return;
      const auto [x, y] = link(out);
      well = thickness(goal, x, y) > least;
    });
    return well;
  }

  bool boundary(int v) const { return !added(v) && original_->halfedges.boundary_vertex(v); }
  int add_vertex(int original_face, const std::array<double, 3>& weights);
  void halve(int h, int middle);
  void join(int a, int b);

  std::shared_ptr<const Surface> original_;
  std::vector<Triangle> faces_;
  std::vector<int> twin_, outgoing_;
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
