#include "coder/loop_filters.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gsp {

namespace {

using Triplet = Eigen::Triplet<double>;

struct Fan {
  int valence = 0;
  int boundary_edges = 0;
};

std::vector<Fan> fans(const SubdivisionLevel& level) {
  std::vector<Fan> fan(level.vertex_count);
  for (int e = 0; e < level.edge_count(); ++e)
    for (int v : level.edges[e]) {
      ++fan[v].valence;
      fan[v].boundary_edges += level.edge_faces[e][1] < 0;
    }
  return fan;
}

/// Weight that a vertex of the given valence keeps.
double kept_weight(int valence) {
  const double c = 3.0 / 8.0 + std::cos(2.0 * M_PI / valence) / 4.0;
  return 3.0 / 8.0 + c * c;
}

int third_vertex(const Triangle& t, int a, int b) {
  for (int v : t)
    if (v != a && v != b) return v;
  return -1;
}

/// The sides of a face that are not `edge`: first the one at vertex `from`, then the one at the other end.
struct OtherSides {
  int at_from, at_to, opposite;
};

class HighPass {
 public:
  HighPass(const SubdivisionLevel& coarse, bool mirror_symmetric)
      : level_(coarse), mirror_symmetric_(mirror_symmetric), fans_(fans(coarse)) {}

  SparseMatrix build() {
    boundary_neighbours();
    // Column by column and then turned: several times faster than sorting all taps by row.
    Eigen::SparseMatrix<double> columns(level_.vertex_count + level_.edge_count(), level_.edge_count());
    columns.reserve(19 * static_cast<Eigen::Index>(level_.edge_count()));
    for (int e = 0; e < level_.edge_count(); ++e) {
      taps_.clear();
      if (level_.edge_faces[e][1] < 0)
        boundary_column(e);
      else
        interior_column(e);
      balance();
      std::sort(taps_.begin(), taps_.end(), [](const Tap& a, const Tap& b) { return a.vertex < b.vertex; });
      columns.startVec(e);
      for (const Tap& tap : taps_) columns.insertBack(tap.vertex, e) = tap.weight;
    }
    columns.finalize();
    return columns;
  }

 private:
  struct Tap {
    int vertex;
    double weight;
  };

  int odd(int edge) const { return level_.vertex_count + edge; }

  /// A vertex that is reached twice, around a valence below 6, keeps its first and nearer tap.
  void add(int vertex, double weight) {
    for (const Tap& tap : taps_)
      if (tap.vertex == vertex) return;
    taps_.push_back({vertex, weight});
  }

  OtherSides sides(int face, int edge, int from, int to) const {
    const int opposite = third_vertex(level_.faces[face], from, to);
    OtherSides s{-1, -1, opposite};
    for (int side : level_.face_edges[face]) {
      if (side == edge) continue;
      const auto& [p, q] = level_.edges[side];
      (p == from || q == from ? s.at_from : s.at_to) = side;
    }
    return s;
  }

  int across(int edge, int face) const {
    const auto& [f, g] = level_.edge_faces[edge];
    return f == face ? g : f;
  }

  bool regular(int v) const { return fans_[v].valence == 6 && fans_[v].boundary_edges == 0; }

  void interior_column(int e) {
    const auto [a, b] = level_.edges[e];
    // Face 0 has the edge in direction a to b and so lies on its left, face 1 on its right.
    add(odd(e), 10.0 / 16);
    add(a, -6.0 / 16);
    add(b, -6.0 / 16);
    near_side(level_.edge_faces[e][0], e, a, b);
    near_side(level_.edge_faces[e][1], e, b, a);
    far_side(level_.edge_faces[e][0], e, a, b);
    far_side(level_.edge_faces[e][1], e, b, a);
    straight_on(e, a, b);
    straight_on(e, b, a);
  }

  /// Taps of the face on the left of `from` -> `to`. The character is -1 along the edge and along its direction turned
  /// by 60°, +1 along the direction turned by 120°: a rule that is the same seen from either end.
  void near_side(int face, int e, int from, int to) {
    const OtherSides s = sides(face, e, from, to);
    add(s.opposite, -2.0 / 16);
    if (mirror_symmetric_) return;
    add(odd(s.at_from), 6.0 / 16);
    add(odd(s.at_to), -6.0 / 16);
  }

  void far_side(int face, int e, int from, int to) {
    const OtherSides s = sides(face, e, from, to);
    wing(face, s.at_from, from, s.opposite, -2.0 / 16);
    wing(face, s.at_to, to, s.opposite, 2.0 / 16);
  }

  /// Beyond side `edge` = (corner, opposite): the midpoint of the wing's edge at the corner, at distance √3, and of the
  /// one at the opposite vertex, at distance 2.
  void wing(int face, int edge, int corner, int opposite, double weight) {
    const int beyond = across(edge, face);
    if (beyond < 0) return;
    const OtherSides s = sides(beyond, edge, corner, opposite);
    if (!mirror_symmetric_) add(odd(s.at_from), weight);
    add(odd(s.at_to), 1.0 / 16);
  }

  /// The edge that continues (from, through) past a regular vertex.
  void straight_on(int e, int from, int through) {
    if (!regular(through)) return;
    int edge = e, face = level_.edge_faces[e][0], behind = from;
    for (int turn = 0; turn < 3; ++turn) {
      const OtherSides s = sides(face, edge, behind, through);
      behind = s.opposite;
      edge = s.at_to;
      face = across(edge, face);
    }
    add(odd(edge), 1.0 / 16);
  }

  void boundary_neighbours() {
    boundary_edges_.assign(level_.vertex_count, {-1, -1});
    for (int e = 0; e < level_.edge_count(); ++e) {
      if (level_.edge_faces[e][1] >= 0) continue;
      for (int v : level_.edges[e]) boundary_edges_[v][boundary_edges_[v][0] < 0 ? 0 : 1] = e;
    }
  }

  void boundary_column(int e) {
    add(odd(e), 6.0 / 8);
    for (int v : level_.edges[e]) add(v, -4.0 / 8);
    for (int v : level_.edges[e]) {
      if (fans_[v].boundary_edges != 2) continue;
      add(odd(boundary_edges_[v][boundary_edges_[v][0] == e ? 1 : 0]), 1.0 / 8);
    }
  }

  void balance() {
    double sum = 0.0, even = 0.0;
    for (const Tap& tap : taps_) {
      sum += tap.weight;
      if (tap.vertex < level_.vertex_count) even += tap.weight;
    }
    for (Tap& tap : taps_)
      if (tap.vertex < level_.vertex_count) tap.weight -= sum * tap.weight / even;
  }

  const SubdivisionLevel& level_;
  bool mirror_symmetric_;
  std::vector<Fan> fans_;
  std::vector<std::array<int, 2>> boundary_edges_;
  std::vector<Tap> taps_;
};

}  // namespace

SparseMatrix loop_low_pass(const SubdivisionLevel& coarse) {
  const int vertices = coarse.vertex_count, edges = coarse.edge_count();
  const std::vector<Fan> fan = fans(coarse);
  std::vector<Triplet> triplets;
  triplets.reserve(vertices + 6 * static_cast<std::size_t>(edges));
  for (int v = 0; v < vertices; ++v) {
    const auto [valence, boundary_edges] = fan[v];
    const bool inside = boundary_edges == 0 && valence > 0;
    triplets.emplace_back(v, v, inside ? kept_weight(valence) : boundary_edges == 2 ? 0.75 : 1.0);
  }
  for (int e = 0; e < edges; ++e) {
    const auto [a, b] = coarse.edges[e];
    const auto [left, right] = coarse.edge_faces[e];
    const bool boundary = right < 0;
    for (const auto& [v, other] : {std::pair{a, b}, std::pair{b, a}}) {
      if (fan[v].boundary_edges == 0)
        triplets.emplace_back(v, other, (1.0 - kept_weight(fan[v].valence)) / fan[v].valence);
      if (fan[v].boundary_edges == 2 && boundary) triplets.emplace_back(v, other, 0.125);
    }
    const int odd = vertices + e;
    triplets.emplace_back(odd, a, boundary ? 0.5 : 0.375);
    triplets.emplace_back(odd, b, boundary ? 0.5 : 0.375);
    if (boundary) continue;
    triplets.emplace_back(odd, third_vertex(coarse.faces[left], a, b), 0.125);
    triplets.emplace_back(odd, third_vertex(coarse.faces[right], a, b), 0.125);
  }
  SparseMatrix matrix(vertices + edges, vertices);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

SparseMatrix loop_high_pass(const SubdivisionLevel& coarse, bool mirror_symmetric) {
  return HighPass(coarse, mirror_symmetric).build();
}

}  // namespace gsp
