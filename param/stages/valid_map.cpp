#include "param/stages/valid_map.h"

#include <algorithm>
#include <sstream>

#include <Eigen/Geometry>

#include "mesh/error.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

/// The face from a point to whose corners triangles span the least area beyond its own: a face that the point lies in,
/// where there is one. O(faces).
int face_at(const Vec3& point, const Mesh& input) {
  int found = -1;
  double least = 0.0;
  for (int f = 0; f < input.face_count(); ++f) {
    double excess = -2.0 * face_area(input, f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = input.positions[input.faces[f][k]] - point,
                 b = input.positions[input.faces[f][(k + 1) % 3]] - point;
      excess += a.cross(b).norm();
    }
    if (found >= 0 && excess >= least) continue;
    found = f;
    least = excess;
  }
  return found;
}

}  // namespace

std::optional<std::string> faults_of(const Parameterization& map) {
  const MapCheck check = check_map(map);
  if (check.valid()) return std::nullopt;
  std::ostringstream text;
  text << check.flipped_faces << " flipped faces, " << check.wrong_angle_vertices << " vertices with a wrong angle, "
       << check.mismatched_edges << " mismatched edges, " << check.torn_edges << " torn edges, "
       << check.misplaced_vertices << " vertices outside their chart, relative area error " << check.area_error;
  return text.str();
}

void refuse_map(const std::string& sentence, const std::optional<Vec3>& at, const Mesh& input) {
  if (!at) throw Error(Cause::InvalidMap, sentence);
  throw Error(Cause::InvalidMap, sentence, Element::Face, face_at(*at, input));
}

void require_valid(const Parameterization& map, const Mesh& input) {
  const auto faults = faults_of(map);
  if (!faults) return;
  const MapCheck check = check_map(map);
  const std::string sentence = "the map is not valid: " + *faults;
  int face = check.first_flipped >= 0 ? check.first_flipped : check.first_torn;
  const int vertex = check.first_wrong_angle >= 0 ? check.first_wrong_angle : check.first_misplaced;
  for (int f = 0; face < 0 && vertex >= 0 && f < map.surface.face_count(); ++f)
    if (std::count(map.surface.faces[f].begin(), map.surface.faces[f].end(), vertex) > 0) face = f;
  if (face < 0) refuse_map(sentence, std::nullopt, input);
  Vec3 middle = Vec3::Zero();
  for (int v : map.surface.faces[face]) middle += map.surface.positions[v] / 3.0;
  refuse_map(sentence, middle, input);
}

}  // namespace gsp
