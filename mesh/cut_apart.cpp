#include "mesh/cut_apart.h"

#include <numeric>
#include <span>

#include "mesh/disjoint_sets.h"
#include "mesh/edge_groups.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

/// The fans of corners that edges hold together. Every fan that is not closed has two ends: a half-edge that leaves its
/// vertex and one that comes in, each without a partner.
class Fans {
 public:
  explicit Fans(const Mesh& mesh)
      : fans_(3 * mesh.faces.size()),
        edge_(3 * mesh.faces.size()),
        leaving_(edge_.size(), -1),
        coming_(edge_.size(), -1) {
    const EdgeGroups edges(mesh);
    std::vector<char> joined(edge_.size(), 0);
    for (int e = 0; e < edges.size(); ++e) {
      const std::span<const int> halves = edges[e];
      for (int h : halves) edge_[h] = e;
      if (halves.size() == 2 && vertex_at(mesh, halves[0]) != vertex_at(mesh, halves[1])) {
        fans_.unite(halves[0], next_corner(halves[1]));
        fans_.unite(next_corner(halves[0]), halves[1]);
        joined[halves[0]] = joined[halves[1]] = 1;
      } else if (halves.size() > 1) {
        ++cut_edges_;
        cut_.insert(cut_.end(), halves.begin(), halves.end());
      }
    }
    for (int corner = 0; corner < static_cast<int>(edge_.size()); ++corner) {
      if (names_vertex_twice(mesh.faces[corner / 3])) continue;
      if (!joined[corner]) leaving_[fans_.root(corner)] = corner;
      if (!joined[previous_corner(corner)]) coming_[fans_.root(corner)] = previous_corner(corner);
    }
    for (int h : cut_) close(h);  // of every open fan with an end on a cut edge
  }

  int root(int corner) { return fans_.root(corner); }
  int cut_edges() const { return cut_edges_; }

 private:
  /// Joins the two ends of the fan that the half-edge leaves where they lie on the same edge. That makes one fan of
  /// those at the edge's other end, whose own ends may then lie on one edge, and so on.
  void close(int h) {
    while (h >= 0) {
      const int fan = root(h), partner = coming_[fan];
      if (leaving_[fan] != h || partner < 0 || edge_[h] != edge_[partner]) return;
      leaving_[fan] = coming_[fan] = -1;
      const int other = root(next_corner(h)),
                next = root(partner);  // h comes in at the first, its partner leaves the other
      const bool closed = other == next;
      const int leaves = closed ? -1 : leaving_[other], comes = closed ? -1 : coming_[next];
      fans_.unite(other, next);
      leaving_[root(next)] = leaves;
      coming_[root(next)] = comes;
      h = leaves;
    }
  }

  DisjointSets fans_;
  std::vector<int> edge_;     ///< #3F half-edge -> edge
  std::vector<int> leaving_;  ///< #3F at roots of open fans
  std::vector<int> coming_;
  std::vector<int> cut_;  ///< half-edges of cut edges
  int cut_edges_ = 0;
};

}  // namespace

CutApart cut_apart(const Mesh& mesh) {
  require_indices(mesh);
  CutApart cut{{mesh, std::vector<int>(mesh.positions.size())}, {}};
  std::iota(cut.surface.original.begin(), cut.surface.original.end(), 0);
  Fans fans(mesh);
  enum Count : char { None, One, More };
  std::vector<Count> around(mesh.positions.size(), None);
  std::vector<int> vertex_of(3 * mesh.faces.size());  // at the root of a fan, which is its smallest corner
  for (int corner = 0; corner < static_cast<int>(vertex_of.size()); ++corner) {
    if (names_vertex_twice(mesh.faces[corner / 3])) continue;
    const int v = vertex_at(mesh, corner);
    if (fans.root(corner) == corner) {
      vertex_of[corner] = around[v] == None ? v : cut.surface.mesh.vertex_count();
      if (around[v] != None) {
        cut.surface.mesh.positions.push_back(mesh.positions[v]);
        cut.surface.original.push_back(v);
      }
      if (around[v] == One) ++cut.counts.vertices;
      around[v] = around[v] == None ? One : More;
    }
    cut.surface.mesh.faces[corner / 3][corner % 3] = vertex_of[fans.root(corner)];
  }
  cut.counts.edges = fans.cut_edges();
  cut.counts.added_vertices = cut.surface.mesh.vertex_count() - mesh.vertex_count();
  return cut;
}

}  // namespace gsp
