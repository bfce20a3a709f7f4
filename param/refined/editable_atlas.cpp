#include "param/refined/editable_atlas.h"

namespace gsp {

LooseMap loosen(const EditableAtlas& map) {
  const std::size_t count = map.vertex.size();
  LooseMap loose{std::vector<int>(count, -1), std::vector<int>(count, -1), std::vector<Complex>(count),
                 std::vector<Transition>(3 * static_cast<std::size_t>(map.refined.face_slots()))};
  const Atlas& atlas = map.atlas;
  for (std::size_t v = 0; v < count; ++v) {
    if (map.vertex[v] < 0) continue;
    loose.patch[v] = atlas.patch[map.vertex[v]];
    loose.position[v] = atlas.position[map.vertex[v]];
    loose.corner[v] = atlas.corner[map.vertex[v]];
  }
  const Surface& surface = *atlas.surface;
  for (std::size_t h = 0; h < map.halfedge.size(); ++h)
    loose.transition[map.halfedge[h]] =
        atlas.towards(surface.edge_of[h], surface.edge_halfedge[surface.edge_of[h]] == static_cast<int>(h));
  return loose;
}

void LooseMap::draw(const TriangleLinks& links, int h) {
  const int v = links.from(h);
  const Transition to_v = transition[h], from_v = to_v.inverse();
  links.for_each_outgoing(v, false, [&](int out) {
    transition[out] = from_v * transition[out];
    transition[Halfedges::prev(out)] = transition[Halfedges::prev(out)] * to_v;
  });
  patch[v] = -1;
}

EditableAtlas tighten(RefinedSurface refined, const LooseMap& loose, BaseComplex base, std::vector<BaseFan> fans) {
  RefinedSurface::Compact compact = refined.compact();
  Atlas atlas;
  atlas.base = std::move(base);
  atlas.fans = std::move(fans);
  const auto surface = std::make_shared<Surface>(std::move(compact.mesh));
  surface->seams = refined.original().seams;
  atlas.surface = surface;
  atlas.first_added = refined.original().mesh.vertex_count();
  const int count = atlas.surface->mesh.vertex_count();
  atlas.patch.assign(count, -1);
  atlas.position.assign(count, 0.0);
  atlas.corner.assign(count, -1);
  for (int v = 0; v < refined.vertex_count(); ++v) {
    const int here = compact.vertex[v];
    if (here < 0) continue;
    atlas.patch[here] = loose.patch[v];
    atlas.position[here] = loose.position[v];
    if (loose.corner[v] < 0) continue;
    atlas.corner[here] = loose.corner[v];
    atlas.base.vertices[loose.corner[v]] = here;
  }
  for (int h : atlas.surface->edge_halfedge) atlas.transition.push_back(loose.transition[compact.halfedge[h]]);
  return {std::move(refined), std::move(atlas), std::move(compact.vertex), std::move(compact.halfedge)};
}

}  // namespace gsp
