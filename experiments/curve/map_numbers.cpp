#include "experiments/curve/map_numbers.h"

#include "metrics/distortion.h"
#include "metrics/smoothness.h"

namespace gsp {

std::map<std::string, double> map_numbers(const ParameterizeResult& result, int input_vertices) {
  const Parameterization& map = result.map;
  const MapCheck check = check_map(map);
  const Distortion d = distortion(map);
  const Smoothness s = smoothness(map);
  std::map<std::string, double> numbers = {{"base_vertices", map.base.vertex_count()},
                                           {"base_faces", map.base.face_count()},
                                           {"flipped_faces", check.flipped_faces},
                                           {"wrong_angle_vertices", check.wrong_angle_vertices},
                                           {"flips_before_repair", result.flips_before_repair},
                                           {"vertices_added", map.surface.vertex_count() - input_vertices},
                                           {"held_vertices", result.held_vertices},
                                           {"corners_moved", result.corners_moved},
                                           {"base_edges_flipped", result.base_edges_flipped},
                                           {"relaxation_rounds", result.relaxation_rounds},
                                           {"anisotropy_mean", d.anisotropy.mean},
                                           {"anisotropy_p95", d.anisotropy.p95},
                                           {"area_symmetric_mean", d.area_symmetric.mean},
                                           {"sorkine_mean", d.sorkine.mean},
                                           {"l2_stretch", d.l2_stretch},
                                           {"smoothness_inside", s.inside.mean},
                                           {"smoothness_across", s.across.mean},
                                           {"smoothness_at_corner", s.at_corner.mean}};
  if (s.across_over_inside) numbers["smoothness_across_over_inside"] = *s.across_over_inside;
  return numbers;
}

}  // namespace gsp
