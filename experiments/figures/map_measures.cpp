#include "experiments/figures/map_measures.h"

namespace gsp {

std::vector<std::string> map_measure_names() { return {"anisotropy", "area", "stretch_l2", "sorkine", "smoothness"}; }

std::vector<MapMeasure> map_measures(const Parameterization& map, const Distortion& d, const Smoothness& s) {
  FaceDistortion faces = face_distortion(map);
  const std::vector<std::string> names = map_measure_names();
  return {{{names[0], std::move(faces.anisotropy)}, {1.0, d.anisotropy.p95}},
          {{names[1], std::move(faces.area)}, {1.0, d.area.p95}},
          {{names[2], std::move(faces.stretch_l2)}, {1.0, d.stretch_l2.p95}},
          {{names[3], std::move(faces.sorkine)}, {1.0, d.sorkine.p95}},
          {{names[4], s.faces}, {0.0, s.all.p95}}};
}

}  // namespace gsp
