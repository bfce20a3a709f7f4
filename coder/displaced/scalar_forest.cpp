#include "coder/displaced/scalar_forest.h"

#include <algorithm>

namespace gsp {

ScalarForest::ScalarForest(const std::vector<SubdivisionLevel>& levels) {
  const EdgeForest edges(levels);
  const int base = levels[0].vertex_count;
  level_begin = {0};
  for (int begin : edges.level_begin) level_begin.push_back(base + begin);
  const auto shifted = [&](std::array<int, 4> nodes) {
    for (int& n : nodes)
      if (n >= 0) n += base;
    return nodes;
  };
  std::array<int, 4> none;
  none.fill(kNone);
  parent.assign(base, kNone);
  children.assign(base, none);
  neighbours.assign(base, none);
  ends.assign(base, {kNone, kNone});
  for (const auto& [a, b] : levels[0].edges)
    for (const auto& [v, w] : {std::pair{a, b}, std::pair{b, a}}) {
      const auto place = std::find(neighbours[v].begin(), neighbours[v].end(), kNone);
      if (place != neighbours[v].end()) *place = w;
    }
  for (int n = 0; n < edges.nodes(); ++n) {
    parent.push_back(edges.parent[n] < 0 ? kNone : base + edges.parent[n]);
    children.push_back(shifted(edges.children[n]));
    neighbours.push_back(shifted(edges.neighbours[n]));
  }
  for (const SubdivisionLevel& level : levels)
    for (const auto& e : level.edges) ends.push_back(e);
}

}  // namespace gsp
