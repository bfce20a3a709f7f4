#include "mesh/halfedges.h"

#include <algorithm>
#include <cstdint>

namespace gsp {

Halfedges::Halfedges(const Mesh& mesh) : twin(3 * mesh.faces.size(), -1), outgoing(mesh.positions.size(), -1) {
  faces = mesh.faces.data();
  // Half-edges grouped by their smaller end vertex: a counting sort that needs no hash and no comparison over all edges.
  const int count = static_cast<int>(twin.size());
  std::vector<int> start(mesh.positions.size() + 1, 0);
  for (int h = 0; h < count; ++h) ++start[std::min(from(h), to(h)) + 1];
  for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  std::vector<int> grouped(count);
  {
    std::vector<int> fill(start.begin(), start.end() - 1);
    for (int h = 0; h < count; ++h) grouped[fill[std::min(from(h), to(h))]++] = h;
  }
  for (std::size_t v = 0; v + 1 < start.size(); ++v) {
    const auto larger = [&](int h) { return std::max(from(h), to(h)); };
    std::sort(grouped.begin() + start[v], grouped.begin() + start[v + 1], [&](int a, int b) {
      return larger(a) != larger(b) ? larger(a) < larger(b) : a < b;
    });
    for (int i = start[v]; i + 1 < start[v + 1]; ++i) {
      const int a = grouped[i], b = grouped[i + 1];
      if (larger(a) == larger(b) && from(a) != from(b)) {
        twin[a] = b;
        twin[b] = a;
        ++i;
      }
    }
  }
  for (int h = 0; h < count; ++h) {
    const int v = from(h);
    if (outgoing[v] < 0 || twin[h] < 0) outgoing[v] = h;
  }
}

bool Halfedges::boundary_vertex(int v) const { return outgoing[v] >= 0 && twin[outgoing[v]] < 0; }

}  // namespace gsp
