#include "cli/check_report.h"

#include <nlohmann/json.hpp>

namespace gsp::cli {

nlohmann::ordered_json check_report(const MapCheck& check) {
  nlohmann::ordered_json report = {{"valid", check.valid()},
                                   {"flipped_faces", check.flipped_faces},
                                   {"area_error", check.area_error},
                                   {"wrong_angle_vertices", check.wrong_angle_vertices},
                                   {"mismatched_edges", check.mismatched_edges},
                                   {"torn_edges", check.torn_edges}};
  if (check.flipped_faces > 0) report["first_flipped_face"] = check.first_flipped;
  if (check.wrong_angle_vertices > 0) report["first_wrong_angle_vertex"] = check.first_wrong_angle;
  if (check.torn_edges > 0) report["first_face_at_torn_edge"] = check.first_torn;
  return report;
}

}  // namespace gsp::cli
