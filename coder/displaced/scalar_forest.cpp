#include "coder/displaced/scalar_forest.h"

#include <algorithm>

#include "coder/edge_forest.h"

namespace gsp {

namespace {

constexpr std::array<int, 4> kNoFour = {-1, -1, -1, -1};

void append(std::array<int, 4>& list, int node) {
  const auto place = std::find(list.begin(), list.end(), ScalarForest::kNone);
  if (place != list.end()) *place = node;
}

/// The part along the normals: the edge forest's nodes behind the base's vertices.
void add_along(ScalarForest& forest, const std::vector<SubdivisionLevel>& levels) {
  const EdgeForest edges({levels.begin(), levels.end() - 1});
  const int base = levels.front().vertex_count;
  const auto shifted = [&](std::array<int, 4> nodes) {
    for (int& n : nodes)
      if (n >= 0) n += base;
    return nodes;
  };
  forest.parent.assign(base, ScalarForest::kNone);
  forest.children.assign(base, kNoFour);
  forest.neighbours.assign(base, kNoFour);
  forest.ends.assign(base, {ScalarForest::kNone, ScalarForest::kNone});
  for (const auto& [a, b] : levels.front().edges) {
    append(forest.neighbours[a], b);
    append(forest.neighbours[b], a);
  }
  for (int n = 0; n < edges.nodes(); ++n) {
    forest.parent.push_back(edges.parent[n] < 0 ? ScalarForest::kNone : base + edges.parent[n]);
    forest.children.push_back(shifted(edges.children[n]));
    forest.neighbours.push_back(shifted(edges.neighbours[n]));
  }
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
    forest.ends.insert(forest.ends.end(), levels[l].edges.begin(), levels[l].edges.end());
  for (int v = 0; v < forest.vertices; ++v) forest.vertex.push_back(v);
}

/// The part across the boundary, whose trees are those of its edges.
class AcrossPart {
 public:
  AcrossPart(ScalarForest& forest, const std::vector<SubdivisionLevel>& levels)
      : forest_(forest), levels_(levels), node_(forest.vertices, ScalarForest::kNone) {}

  void add_level(int level) {
    const int begin = forest_.nodes();
    if (level == 0) {
      const std::vector<VertexFan> fans = vertex_fans(levels_[0]);
      for (int v = 0; v < levels_[0].vertex_count; ++v)
        if (fans[v].sharp_count == 2) add(v);
      for (int n = begin; n < forest_.nodes(); ++n)
        for (int e : fans[forest_.vertex[n]].sharp_edges)
          if (const int w = node_[levels_[0].other_end(e, forest_.vertex[n])]; w >= 0) append(forest_.neighbours[n], w);
    } else {
      add_edges(levels_[level - 1]);
    }
    forest_.groups.push_back({level, true, begin, forest_.nodes()});
  }

 private:
  void add(int v) {
    node_[v] = forest_.nodes();
    forest_.vertex.push_back(v);
    forest_.parent.push_back(ScalarForest::kNone);
    forest_.children.push_back(kNoFour);
    forest_.neighbours.push_back(kNoFour);
    forest_.ends.push_back({ScalarForest::kNone, ScalarForest::kNone});
  }

  void add_edges(const SubdivisionLevel& coarse) {
    const int begin = forest_.nodes();
    for (int e = 0; e < coarse.edge_count(); ++e)
      if (coarse.edge_faces[e][1] < 0) add(coarse.vertex_count + e);
    const std::vector<VertexFan> fans = vertex_fans(coarse);
    for (int n = begin; n < forest_.nodes(); ++n) {
      const int v = forest_.vertex[n], e = v - coarse.vertex_count;
      for (int k = 0; k < 2; ++k) {
        const int end = coarse.edges[e][k];
        forest_.ends[n][k] = node_[end];
        if (fans[end].sharp_count != 2) continue;
        for (int other : fans[end].sharp_edges)
          if (other != e) append(forest_.neighbours[n], node_[coarse.vertex_count + other]);
      }
      const int parent = forest_.parent[v] < 0 ? ScalarForest::kNone : node_[forest_.vertex[forest_.parent[v]]];
      forest_.parent[n] = parent;
      if (parent >= 0) append(forest_.children[parent], n);
    }
  }

  ScalarForest& forest_;
  const std::vector<SubdivisionLevel>& levels_;
  std::vector<int> node_;  ///< #V, kNone inside
};

}  // namespace

ScalarForest::ScalarForest(const std::vector<SubdivisionLevel>& levels) : vertices(levels.back().vertex_count) {
  add_along(*this, levels);
  AcrossPart across(*this, levels);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    groups.push_back({static_cast<int>(l), false, l == 0 ? 0 : levels[l - 1].vertex_count, levels[l].vertex_count});
    across.add_level(static_cast<int>(l));
  }
}

}  // namespace gsp
