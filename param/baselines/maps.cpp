#include "param/baselines/maps.h"

namespace gsp {

std::optional<OverlayMap> maps_overlay(const SimplifyResult& simplified, std::optional<Vec3>* unplaced) {
  std::optional<OverlayMap> map(std::in_place, simplified.surface(), OverlayMap::Winding::Allowed);
  Star star;
  Removal removal;
  for (int i = 0; i < simplified.removals.size(); ++i) {
    map->complex().gather(simplified.removals.vertex(i), star);
    simplified.removals.place(i, star, removal);
    if (map->remove(removal)) continue;
    if (unplaced) *unplaced = simplified.surface()->mesh.positions[simplified.removals.vertex(i)];
    return std::nullopt;
  }
  return map;
}

}  // namespace gsp
