#pragma once

#include <utility>
#include <vector>

#include "param/refined/refined_surface.h"

namespace gsp {

/// Share of the triangle that holds it, below which rounding could fold a piece.
inline constexpr double kLeastPiece = 1e-13;

/// Some faces of a refined surface laid into the plane, where they are embedded, to be cut along straight lines.
/// Vertices on the region's border stay where they are; those on a cut stay on it; others may be moved to keep pieces
/// thick and large enough. All vectors are kept from region to region.
class PlanarRegion {
 public:
  enum class Hold : char { Free, Edge, Ring };  ///< Edge: on a cut; Ring: fixed
  using Line = std::pair<int, int>;             ///< the fixed vertices that a cut joins

  explicit PlanarRegion(RefinedSurface& refined) : refined_(refined) {}

  /// Takes the faces; the caller then sets `flat` and `hold` of every vertex of `vertices()`.
  void begin(const std::vector<int>& faces);
  void leave();

  const std::vector<int>& faces() const { return faces_; }  ///< further ones, made by cuts, come last
  const std::vector<int>& vertices() const { return vertices_; }
  bool holds_face(int face) const { return face < static_cast<int>(inside_.size()) && inside_[face]; }
  Complex flat(int v) const { return flat_[v]; }
  Hold hold(int v) const { return hold_[v]; }
  Line line(int v) const { return line_[v]; }  ///< of a vertex that is held on an edge
  void place(int v, Complex at, Hold hold) {
    flat_[v] = at;
    hold_[v] = hold;
  }
  void put_on(int v, Line line) {
    hold_[v] = Hold::Edge;
    line_[v] = line;
  }
  /// How far along its line a vertex held on an edge is, 0 at the line's first end, 1 at its second.
  double share_on_line(int v) const { return share_on_line(v, flat_[v]); }

  /// Makes a vertex at a place inside the region and holds it there; -1 where no piece of positive area holds the
  /// place.
  int insert(Complex at);
  /// Cuts the pieces along the straight line between two fixed vertices, if they can be.
  bool cut(int start, int end);
  /// Moves vertices of pieces that are too thin, or too small for rounding, toward the middle of their neighbours.
  /// Otherwise pieces get worse from region to region, and thin ones are cut most often.
  void relax();
  /// Takes added vertices on no cut out again where the pieces stay thick enough.
  void take_out();
  double area(int face) const;

 private:
  double share_on_line(int v, Complex at) const;
  int added(int v, Complex at);
  bool movable(int v) const;
  bool move_to(int v, Complex to, double share);
  int next_on_cut(int at, int target);
  double least_quality(int v, Complex at) const;
  bool relax(int v);

  RefinedSurface& refined_;
  std::vector<int> faces_, vertices_;
  std::vector<char> inside_;     ///< per face
  std::vector<char> in_region_;  ///< per vertex
  std::vector<Complex> flat_;    ///< per vertex
  std::vector<Hold> hold_;       ///< per vertex
  std::vector<Line> line_;       ///< per vertex
  std::vector<int> moving_;
};

}  // namespace gsp
