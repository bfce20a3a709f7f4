#include "coder/loop_high_pass.h"

#include <algorithm>
#include <array>
#include <vector>

namespace gsp {

namespace {

class HighPass : public TapFilter<HighPass> {
 public:
  HighPass(const SubdivisionLevel& coarse, bool mirror_symmetric)
      : TapFilter(coarse), mirror_symmetric_(mirror_symmetric), fans_(vertex_fans(coarse)) {}

  template <class Take>
  void for_each_tap(Take take) const {
    for (int e = 0; e < level_.edge_count(); ++e) taps_of(e, take);
  }

  /// In a short prefix most details are zero, and finding the taps is most of the work.
  void add(const Vec3* x, Vec3* y) const override {
    for (int e = 0; e < level_.edge_count(); ++e)
      if (x[e] != Vec3::Zero()) taps_of(e, [&](int to, int from, double weight) { y[to] += weight * x[from]; });
  }

 private:
  template <class Take>
  void taps_of(int e, Take take) const {
    Column column{e, !level_.sharp(e) && distinct(e)};
    if (level_.sharp(e))
      curve_taps(column);
    else
      interior_taps(column);
    if (!column.distinct) {
      leave_creases(column);
      balance(column);
    }
    for (int i = 0; i < column.size; ++i) take(column.taps[i].to, e, column.taps[i].weight);
  }

  /// The taps of one edge.
  struct Column {
    struct Tap {
      int to;
      double weight;
    };
    int edge;
    bool distinct;  ///< no vertex is reached twice
    int size = 0;
    std::array<Tap, 19> taps = {};

    void add(int vertex, double weight) {
      // A vertex that is reached twice, around a valence below 6, keeps its first and nearer tap.
      if (!distinct)
        for (int i = 0; i < size; ++i)
          if (taps[i].to == vertex) return;
      taps[size++] = {vertex, weight};
    }
  };

  /// Between regular vertices all taps exist and sum to zero.
  bool distinct(int e) const {
    for (int v : level_.edges[e])
      if (!fans_[v].regular()) return false;
    for (int face : level_.edge_faces[e])
      if (!fans_[level_.opposite_vertex(face, e)].regular()) return false;
    return true;
  }

  /// The sides of a face that are not `edge`: first the one at vertex `from`, then the one at the other end.
  struct OtherSides {
    int at_from, at_to, opposite;
  };
  OtherSides sides(int face, int edge, int from) const {
    const std::array<int, 3>& s = level_.face_edges[face];
    const Triangle& corners = level_.faces[face];
    const int k = s[0] == edge ? 0 : s[1] == edge ? 1 : 2;
    const int next = s[(k + 1) % 3], previous = s[(k + 2) % 3];
    const bool forward = corners[k] == from;
    return {forward ? previous : next, forward ? next : previous, corners[(k + 2) % 3]};
  }

  void interior_taps(Column& column) const {
    const int e = column.edge;
    const auto [a, b] = level_.edges[e];
    // Face 0 has the edge in direction a to b and so lies on its left, face 1 on its right.
    const auto [left, right] = level_.edge_faces[e];
    const OtherSides on_left = sides(left, e, a), on_right = sides(right, e, b);
    column.add(odd(e), 10.0 / 16);
    column.add(a, -6.0 / 16);
    column.add(b, -6.0 / 16);
    near_side(column, on_left);
    near_side(column, on_right);
    far_side(column, left, on_left, a, b);
    far_side(column, right, on_right, b, a);
    straight_on(column, a, b);
    straight_on(column, b, a);
  }

  /// Taps of the face on the left of `from` -> `to`. The character is -1 along the edge and along its direction turned
  /// by 60°, +1 along the direction turned by 120°: a rule that is the same seen from either end.
  void near_side(Column& column, const OtherSides& s) const {
    column.add(s.opposite, -2.0 / 16);
    if (mirror_symmetric_) return;
    column.add(odd(s.at_from), 6.0 / 16);
    column.add(odd(s.at_to), -6.0 / 16);
  }

  void far_side(Column& column, int face, const OtherSides& s, int from, int to) const {
    wing(column, face, s.at_from, from, -2.0 / 16);
    wing(column, face, s.at_to, to, 2.0 / 16);
  }

  /// Beyond side `edge` = (corner, opposite): the midpoint of the wing's edge at the corner, at distance √3, and of the
  /// one at the opposite vertex, at distance 2.
  void wing(Column& column, int face, int edge, int corner, double weight) const {
    const int beyond = level_.smooth_face(edge, face);
    if (beyond < 0) return;
    const OtherSides s = sides(beyond, edge, corner);
    if (!mirror_symmetric_) column.add(odd(s.at_from), weight);
    column.add(odd(s.at_to), 1.0 / 16);
  }

  /// The edge that continues (from, through) past a regular vertex.
  void straight_on(Column& column, int from, int through) const {
    if (!fans_[through].regular()) return;
    int edge = column.edge, face = level_.edge_faces[edge][0], behind = from;
    for (int turn = 0; turn < 3; ++turn) {
      const OtherSides s = sides(face, edge, behind);
      behind = s.opposite;
      edge = s.at_to;
      face = level_.other_face(edge, face);
    }
    column.add(odd(edge), 1.0 / 16);
  }

  void curve_taps(Column& column) const {
    const int e = column.edge;
    column.add(odd(e), 6.0 / 8);
    for (int v : level_.edges[e]) column.add(v, -4.0 / 8);
    for (int v : level_.edges[e])
      if (fans_[v].on_curve()) column.add(odd(fans_[v].beyond(e)), 1.0 / 8);
  }

  /// A detail beside a crease does not move it, and one of a crease neither its corners nor its ends: creases are
  /// curves of their own, the same whatever the surface on either side does.
  void leave_creases(Column& column) const {
    // Between two creases the even taps that are left would have to be large to make up for those at the ends.
    const auto [a, b] = level_.edges[column.edge];
    if (!level_.creased[column.edge] && fans_[a].on_crease() && fans_[b].on_crease()) column.size = 1;
    const auto left_out = [&](const Column::Tap& tap) {
      const int v = tap.to, inserted_on = v - level_.vertex_count;
      if (level_.creased[column.edge]) return inserted_on < 0 && !fans_[v].on_curve();
      return inserted_on < 0 ? fans_[v].on_crease() : level_.creased[inserted_on] != 0;
    };
    const auto end = std::remove_if(column.taps.begin(), column.taps.begin() + column.size, left_out);
    column.size = static_cast<int>(end - column.taps.begin());
  }

  void balance(Column& column) const {
    double sum = 0.0, even = 0.0;
    for (int i = 0; i < column.size; ++i) {
      sum += column.taps[i].weight;
      if (column.taps[i].to < level_.vertex_count) even += column.taps[i].weight;
    }
    // Where creases leave no even tap there is nothing to balance.
    if (even == 0.0) return;
    for (int i = 0; i < column.size; ++i) {
      Column::Tap& tap = column.taps[i];
      if (tap.to < level_.vertex_count) tap.weight -= sum * tap.weight / even;
    }
  }

  bool mirror_symmetric_;
  std::vector<VertexFan> fans_;
};

}  // namespace

std::unique_ptr<Filter> loop_high_pass(const SubdivisionLevel& coarse, bool mirror_symmetric) {
  return std::make_unique<HighPass>(coarse, mirror_symmetric);
}

}  // namespace gsp
