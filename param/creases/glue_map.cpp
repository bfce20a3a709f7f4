#include "param/creases/glue_map.h"

#include <algorithm>

#include "mesh/edge.h"

namespace gsp {

namespace {

/// The base glued together; what was on its boundary and is no more becomes a crease.
BaseComplex glue_base(const BaseComplex& cut_base, const CutSurface& cut, int whole_vertices) {
  BaseComplex base;
  std::vector<int> number(whole_vertices, -1), glued;
  for (int v : cut_base.vertices) {
    int& at = number[cut.whole(v)];
    if (at < 0) {
      at = base.vertex_count();
      base.vertices.push_back(cut.whole(v));
    }
    glued.push_back(at);
  }
  for (const Triangle& t : cut_base.faces) base.faces.push_back({glued[t[0]], glued[t[1]], glued[t[2]]});
  base.connect();
  for (int h = 0; h < static_cast<int>(base.twins.size()); ++h) {
    if (cut_base.twins[h] >= 0 || base.twins[h] < h) continue;
    base.creases.push_back(ascending(base.faces[h / 3][h % 3], base.faces[h / 3][(h + 1) % 3]));
  }
  std::sort(base.creases.begin(), base.creases.end());
  return base;
}

}  // namespace

Parameterization glue_map(Parameterization map, const CutSurface& cut) {
  const int count = map.surface.vertex_count(), whole = count - static_cast<int>(cut.original.size());
  const std::vector<Vec3> positions = std::move(map.surface.positions);
  const std::vector<int> patch = std::move(map.patch);
  const std::vector<Complex> position = std::move(map.position);
  map.surface.positions.assign(whole, Vec3::Zero());
  map.patch.assign(whole, -1);
  map.position.assign(whole, 0.0);
  for (int v = count - 1; v >= 0; --v) {  // the first copy last, whose place stays
    const int at = cut.whole(v);
    map.surface.positions[at] = positions[v];
    if (patch[v] < 0) continue;
    map.patch[at] = patch[v];
    map.position[at] = position[v];
  }
  for (Triangle& t : map.surface.faces)
    for (int& v : t) v = cut.whole(v);
  map.base = glue_base(map.base, cut, whole);
  return map;
}

}  // namespace gsp
