#include "param/creases/cut_surface.h"

#include <algorithm>
#include <set>

#include "mesh/edge.h"
#include "mesh/features/cut.h"
#include "param/atlas/split_edges.h"

namespace gsp {

namespace {

/// Vertices inside a curve have two copies; where it ends, meets others or the boundary, they are corners.
Seams seams_of(const Mesh& whole, const FeatureEdges& features, const CutMesh& cut) {
  const Halfedges halfedges(whole);
  std::vector<int> edges_at(whole.positions.size(), 0), number(whole.positions.size(), -1), last(number);
  for (const auto& edge : features)
    for (int v : edge) ++edges_at[v];
  Seams seams{std::vector<int>(cut.original.size(), -1), std::vector<int>(cut.original.size(), -1), 0};
  for (std::size_t v = 0; v < cut.original.size(); ++v) {
    const int original = cut.original[v];
    if (edges_at[original] == 0) continue;
    if (number[original] < 0) number[original] = seams.points++;
    seams.point[v] = number[original];
    if (last[original] >= 0 && edges_at[original] == 2 && !halfedges.boundary_vertex(original)) {
      seams.other[v] = last[original];
      seams.other[last[original]] = static_cast<int>(v);
    }
    last[original] = static_cast<int>(v);
  }
  return seams;
}

}  // namespace

CutSurface cut_surface(const Mesh& mesh, const FeatureEdges& features) {
  CutMesh cut = cut_along(mesh, features);
  Seams seams = seams_of(mesh, features, cut);
  split_boundary_chords(cut.mesh);
  CutSurface result;
  const auto surface = std::make_shared<Surface>(std::move(cut.mesh));
  surface->seams = std::move(seams);
  result.surface = surface;
  result.whole_vertices = mesh.vertex_count();
  result.original.assign(cut.original.begin() + mesh.vertex_count(), cut.original.end());
  return result;
}

FeatureEdges split_features(const FeatureEdges& features, const std::vector<std::array<int, 2>>& ends,
                            int first_middle) {
  std::set<std::array<int, 2>> edges(features.begin(), features.end());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int middle = first_middle + static_cast<int>(i);
    const auto [a, b] = ascending(ends[i][0], ends[i][1]);
    if (edges.erase({a, b}) == 0) continue;
    edges.insert({a, middle});  // middles come last
    edges.insert({b, middle});
  }
  return {edges.begin(), edges.end()};
}

}  // namespace gsp
