#include "mesh/edge_groups.h"

#include <algorithm>

namespace gsp {

EdgeGroups::EdgeGroups(const Mesh& mesh) {
  struct Half {
    int larger;
    int index;
  };
  // A counting sort by the smaller vertex, then short sorts: no hash, which hostile input could make slow.
  std::vector<int> fill(mesh.positions.size() + 1, 0);
  const auto for_each = [&](auto&& use) {
    for (int f = 0; f < mesh.face_count(); ++f) {
      const Triangle& t = mesh.faces[f];
      if (names_vertex_twice(t)) continue;
      for (int k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        use(std::min(a, b), std::max(a, b), 3 * f + k);
      }
    }
  };
  for_each([&](int smaller, int, int) { ++fill[smaller + 1]; });
  for (std::size_t v = 1; v < fill.size(); ++v) fill[v] += fill[v - 1];
  const std::vector<int> begin = fill;
  std::vector<Half> halves(fill.back());
  for_each([&](int smaller, int larger, int index) { halves[fill[smaller]++] = {larger, index}; });
  halfedges_.reserve(halves.size());
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    const auto first = halves.begin() + begin[v], last = halves.begin() + begin[v + 1];
    std::sort(first, last,
              [](Half a, Half b) { return a.larger != b.larger ? a.larger < b.larger : a.index < b.index; });
    for (auto half = first; half != last; ++half) {
      if (half == first || half->larger != (half - 1)->larger) starts_.push_back(static_cast<int>(halfedges_.size()));
      halfedges_.push_back(half->index);
    }
  }
  starts_.push_back(static_cast<int>(halfedges_.size()));
}

}  // namespace gsp
