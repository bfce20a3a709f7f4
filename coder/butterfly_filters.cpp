#include "coder/butterfly_filters.h"

#include <array>
#include <cmath>
#include <vector>

namespace gsp {

namespace {

using Triplet = Eigen::Triplet<double>;

class Butterfly {
 public:
  explicit Butterfly(const SubdivisionLevel& coarse) : level_(coarse) {
    valence_.assign(coarse.vertex_count, 0);
    boundary_edges_.assign(coarse.vertex_count, {-1, -1});
    for (int e = 0; e < coarse.edge_count(); ++e)
      for (int v : coarse.edges[e]) {
        ++valence_[v];
        if (coarse.edge_faces[e][1] < 0) boundary_edges_[v][boundary_edges_[v][0] < 0 ? 0 : 1] = e;
      }
  }

  SparseMatrix build() {
    for (int v = 0; v < level_.vertex_count; ++v) triplets_.emplace_back(v, v, 1.0);
    for (int e = 0; e < level_.edge_count(); ++e) {
      row_ = level_.vertex_count + e;
      if (level_.edge_faces[e][1] < 0)
        boundary_edge(e);
      else
        inner_edge(e);
    }
    SparseMatrix matrix(level_.vertex_count + level_.edge_count(), level_.vertex_count);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    return matrix;
  }

 private:
  void add(int vertex, double weight) { triplets_.emplace_back(row_, vertex, weight); }

  bool irregular(int v) const { return boundary_edges_[v][0] < 0 && valence_[v] != 6 && valence_[v] >= 3; }

  int third_vertex(int face, int a, int b) const {
    for (int v : level_.faces[face])
      if (v != a && v != b) return v;
    return a;
  }

  int other_end(int edge, int v) const { return level_.edges[edge][0] == v ? level_.edges[edge][1] : level_.edges[edge][0]; }

  int across(int edge, int face) const {
    const auto& [f, g] = level_.edge_faces[edge];
    return f == face ? g : f;
  }

  /// The side of `face` at `v` that is not `edge`.
  int other_side_at(int face, int edge, int v) const {
    for (int side : level_.face_edges[face])
      if (side != edge && (level_.edges[side][0] == v || level_.edges[side][1] == v)) return side;
    return edge;
  }

  void inner_edge(int e) {
    const auto [a, b] = level_.edges[e];
    if (!irregular(a) && !irregular(b)) return regular_stencil(e);
    const double share = irregular(a) && irregular(b) ? 0.5 : 1.0;
    if (irregular(a)) irregular_stencil(e, a, share);
    if (irregular(b)) irregular_stencil(e, b, share);
  }

  void regular_stencil(int e) {
    const auto [a, b] = level_.edges[e];
    for (int v : {a, b}) add(v, 0.5);
    for (int face : level_.edge_faces[e]) {
      const int opposite = third_vertex(face, a, b);
      add(opposite, 0.125);
      for (const auto& [corner, far] : {std::pair{a, b}, std::pair{b, a}}) {
        const int side = other_side_at(face, e, corner), beyond = across(side, face);
        if (beyond >= 0) {
          add(third_vertex(beyond, corner, opposite), -1.0 / 16);
        } else {
          add(corner, -1.0 / 16);
          add(opposite, -1.0 / 16);
          add(far, 1.0 / 16);
        }
      }
    }
  }

  /// The rule around the irregular vertex `centre`, which is the same in both directions around it.
  void irregular_stencil(int e, int centre, double share) {
    const int k = valence_[centre];
    add(centre, 0.75 * share);
    int edge = e, face = level_.edge_faces[e][0];
    for (int j = 0; j < k; ++j) {
      add(other_end(edge, centre), share * neighbour_weight(k, j));
      if (face < 0) break;
      edge = other_side_at(face, edge, centre);
      face = across(edge, face);
    }
  }

  static double neighbour_weight(int k, int j) {
    if (k == 3) return j == 0 ? 5.0 / 12 : -1.0 / 12;
    if (k == 4) return j == 0 ? 3.0 / 8 : j == 2 ? -1.0 / 8 : 0.0;
    const double angle = 2.0 * M_PI * j / k;
    return (0.25 + std::cos(angle) + 0.5 * std::cos(2.0 * angle)) / k;
  }

  void boundary_edge(int e) {
    const auto [a, b] = level_.edges[e];
    for (const auto& [near, far] : {std::pair{a, b}, std::pair{b, a}}) {
      add(near, 9.0 / 16);
      const auto& [first, second] = boundary_edges_[near];
      const int next = first == e ? second : first;
      if (next >= 0) {
        add(other_end(next, near), -1.0 / 16);
      } else {
        add(near, -2.0 / 16);
        add(far, 1.0 / 16);
      }
    }
  }

  const SubdivisionLevel& level_;
  std::vector<int> valence_;
  std::vector<std::array<int, 2>> boundary_edges_;
  std::vector<Triplet> triplets_;
  int row_ = 0;
};

}  // namespace

SparseMatrix butterfly_low_pass(const SubdivisionLevel& coarse) { return Butterfly(coarse).build(); }

SparseMatrix butterfly_update(const SubdivisionLevel& coarse) {
  std::vector<int> faces(coarse.vertex_count, 0);
  for (const Triangle& t : coarse.faces)
    for (int v : t) ++faces[v];
  std::vector<Triplet> triplets;
  triplets.reserve(2 * coarse.edges.size());
  for (int e = 0; e < coarse.edge_count(); ++e) {
    const int around = coarse.edge_faces[e][1] < 0 ? 3 : 6;
    for (int v : coarse.edges[e]) triplets.emplace_back(v, e, around / (8.0 * faces[v]));
  }
  SparseMatrix matrix(coarse.vertex_count, coarse.edge_count());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace gsp
