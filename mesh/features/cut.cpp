#include "mesh/features/cut.h"

#include <algorithm>
#include <numeric>

#include "mesh/edge.h"
#include "mesh/halfedges.h"

namespace gsp {

CutMesh cut_along(const Mesh& mesh, const FeatureEdges& edges) {
  CutMesh cut{mesh, std::vector<int>(mesh.positions.size())};
  std::iota(cut.original.begin(), cut.original.end(), 0);
  const Halfedges halfedges(mesh);
  const auto is_cut = [&](int h) {
    return std::binary_search(edges.begin(), edges.end(), ascending(halfedges.from(h), halfedges.to(h)));
  };
  std::vector<char> on_cut(mesh.positions.size(), 0);
  for (const auto& edge : edges)
    for (int v : edge) on_cut[v] = 1;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!on_cut[v] || halfedges.outgoing[v] < 0) continue;
    int start = halfedges.outgoing[v];
    if (!halfedges.boundary_vertex(v))
      while (!is_cut(start)) start = halfedges.rotate_ccw(start);
    int copy = v, h = start;
    do {
      if (h != start && is_cut(h)) {
        copy = cut.mesh.vertex_count();
        cut.mesh.positions.push_back(mesh.positions[v]);
        cut.original.push_back(v);
      }
      cut.mesh.faces[h / 3][h % 3] = copy;
      h = halfedges.rotate_ccw(h);
    } while (h >= 0 && h != start);
  }
  return cut;
}

Mesh glue(const CutMesh& cut) {
  Mesh mesh = cut.mesh;
  for (Triangle& t : mesh.faces)
    for (int& v : t) v = cut.original[v];
  const auto whole =
      std::find_if(cut.original.begin(), cut.original.end(), [&, i = 0](int v) mutable { return v != i++; });
  mesh.positions.resize(whole - cut.original.begin());
  return mesh;
}

}  // namespace gsp
