#include "coder/edge_forest.h"

#include <algorithm>

namespace gsp {

namespace {

/// Edge of `coarse` that edge `e` of the next level is a half of, or parallel to inside a face.
int parent_edge(const SubdivisionLevel& coarse, const SubdivisionLevel& fine, int e) {
  const int a = fine.edges[e][0] - coarse.vertex_count, b = fine.edges[e][1] - coarse.vertex_count;
  if (a < 0) return b;
  if (b < 0) return a;
  for (int side : coarse.face_edges[fine.edge_faces[e][0] / 4])
    if (side != a && side != b) return side;
  return EdgeForest::kNone;
}

std::array<int, 4> other_sides(const SubdivisionLevel& level, int e, int first_node) {
  std::array<int, 4> sides;
  sides.fill(EdgeForest::kNone);
  int count = 0;
  for (int face : level.edge_faces[e]) {
    if (face < 0) continue;
    for (int side : level.face_edges[face])
      if (side != e) sides[count++] = first_node + side;
  }
  return sides;
}

}  // namespace

EdgeForest::EdgeForest(const std::vector<SubdivisionLevel>& levels) {
  int nodes = 0;
  for (const SubdivisionLevel& level : levels) {
    level_begin.push_back(nodes);
    nodes += level.edge_count();
  }
  level_begin.push_back(nodes);
  parent.reserve(nodes);
  neighbours.reserve(nodes);
  children.resize(nodes);
  for (auto& c : children) c.fill(kNone);
  for (std::size_t l = 0; l < levels.size(); ++l)
    for (int e = 0; e < levels[l].edge_count(); ++e) {
      const int node = static_cast<int>(parent.size());
      parent.push_back(l == 0 ? kNone : level_begin[l - 1] + parent_edge(levels[l - 1], levels[l], e));
      creased.push_back(levels[l].creased[e]);
      neighbours.push_back(other_sides(levels[l], e, level_begin[l]));
      if (l > 0) *std::find(children[parent.back()].begin(), children[parent.back()].end(), kNone) = node;
    }
}

}  // namespace gsp
