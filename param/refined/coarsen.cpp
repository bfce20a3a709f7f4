#include "param/refined/coarsen.h"

namespace gsp {

namespace {

constexpr int kPasses = 3;  // a vertex may have to wait for its neighbours

/// Draws an added vertex onto a neighbour if it can be; tells whether it could.
bool take_out(int v, RefinedSurface& refined, LooseMap& map) {
  const auto link = [&](int out) { return map.link(refined.links(), out); };
  const int along = refined.collapsible(v, map.position[v], link);
  if (along < 0) return false;
  map.draw(refined.links(), along);
  refined.collapse(along);
  return true;
}

}  // namespace

EditableAtlas coarsen(EditableAtlas map) {
  LooseMap loose = loosen(map);
  RefinedSurface& refined = map.refined;
  bool any = true;
  for (int pass = 0; pass < kPasses && any; ++pass) {
    any = false;
    for (int v = refined.original().mesh.vertex_count(); v < refined.vertex_count(); ++v)
      if (loose.patch[v] >= 0 && loose.corner[v] < 0) any |= take_out(v, refined, loose);
  }
  return tighten(std::move(refined), loose, std::move(map.atlas.base), std::move(map.atlas.fans));
}

}  // namespace gsp
