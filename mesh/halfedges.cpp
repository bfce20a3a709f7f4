#include "mesh/halfedges.h"

#include "mesh/edge_groups.h"

namespace gsp {

Halfedges::Halfedges(const Mesh& mesh) : twin(3 * mesh.faces.size(), -1), outgoing(mesh.positions.size(), -1) {
  faces = mesh.faces.data();
  const EdgeGroups edges(mesh);
  for (int e = 0; e < edges.size(); ++e) {
    const std::span<const int> halves = edges[e];
    for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
      if (from(halves[i]) == from(halves[i + 1])) continue;
      twin[halves[i]] = halves[i + 1];
      twin[halves[i + 1]] = halves[i];
      ++i;
    }
  }
  for (int h = 0; h < static_cast<int>(twin.size()); ++h) {
    const int v = from(h);
    if (outgoing[v] < 0 || twin[h] < 0) outgoing[v] = h;
  }
}

bool Halfedges::boundary_vertex(int v) const { return outgoing[v] >= 0 && twin[outgoing[v]] < 0; }

}  // namespace gsp
