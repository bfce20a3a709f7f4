#include "experiments/figures/sector_disc.h"

#include "coder/wavelet_transform.h"
#include "experiments/figures/remesh_map.h"
#include "mesh/shapes.h"
#include "param/global_system.h"

namespace gsp {

namespace {

SemiregularMesh unrefined(int sectors) {
  const Mesh disc = shapes::sector_disc(sectors, 0);
  return {.level = 0, .base_vertices = disc.vertex_count(), .base_faces = disc.faces, .positions = disc.positions};
}

/// From the chart of base face `from` into that of `to`, which is it or beside it: the spokes and the base faces are
/// all that the vertices of an edge that is no longer than a face can be told apart by.
Transition beside(const BaseComplex& base, int from, int to) {
  if (from == to) return {};
  for (int k = 0; k < 3; ++k)
    if (const int twin = base.twins[3 * from + k]; twin >= 0 && twin / 3 == to) return base.across(3 * from + k);
  throw Error(Cause::Internal, "an edge of a sector disc reaches over more than one spoke");
}

/// An atlas of a map whose faces each lie in one base face.
Atlas atlas_of(const Parameterization& map) {
  Atlas atlas;
  atlas.surface = std::make_shared<Surface>(map.surface);
  atlas.base = map.base;
  atlas.fans = base_fans(map.base);
  atlas.patch = map.patch;
  atlas.position = map.position;
  atlas.corner.assign(map.patch.size(), -1);
  for (int b = 0; b < map.base.vertex_count(); ++b) atlas.corner[map.base.vertices[b]] = b;
  const Surface& surface = *atlas.surface;
  for (int e = 0; e < surface.edge_count(); ++e) {
    // By way of the chart of the face beside the edge, which is that of either end or beside it.
    const int h = surface.edge_halfedge[e], chart = map.face_chart[h / 3];
    const int start = map.patch[surface.halfedges.from(h)], end = map.patch[surface.halfedges.to(h)];
    const auto into = [&](int vertex, int patch) {
      // The centre is at corner 0 of every sector, so that no change of chart moves it.
      return vertex == map.base.vertices[0] ? Transition{} : beside(map.base, patch, chart);
    };
    atlas.transition.push_back(into(surface.halfedges.from(h), start).inverse() * into(surface.halfedges.to(h), end));
  }
  return atlas;
}

}  // namespace

Parameterization relaxed_sector_disc(int sectors, int level) {
  Atlas atlas = atlas_of(remesh_as_map(at_level(unrefined(sectors), level)));
  atlas.position = solve_global(atlas, mean_value_weights(*atlas.surface), interior_vertices(atlas));
  atlas.reassign_all();
  return atlas.finish({});
}

Parameterization loop_sector_disc(int sectors, int level) {
  SemiregularMesh disc = unrefined(sectors);
  const WaveletTransform loop(subdivision_levels(disc.base_vertices, disc.base_faces, level - 1), Wavelet::Loop);
  for (int l = 0; l < level; ++l) {
    const std::size_t coarse = disc.positions.size();
    const std::size_t fine = subdivision_levels(disc.base_vertices, disc.base_faces, l + 1).back().vertex_count;
    disc.positions = loop.synthesis(l, disc.positions, std::vector<Vec3>(fine - coarse, Vec3::Zero()));
  }
  disc.level = level;
  return remesh_as_map(disc);
}

}  // namespace gsp
