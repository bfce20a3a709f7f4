#include "remesh/fold_guard.h"

#include <Eigen/Geometry>

namespace gsp {

namespace {

std::vector<Vec3> doubled_areas(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<Vec3> areas(level.faces.size());
  for (std::size_t f = 0; f < areas.size(); ++f) areas[f] = doubled_area(level.faces[f], positions);
  return areas;
}

bool folded(const Vec3& a, const Vec3& b) {
  constexpr double kCosine30 = 0.8660254037844386;
  return a.dot(b) < -kCosine30 * a.norm() * b.norm();
}

}  // namespace

Vec3 doubled_area(const Triangle& face, const std::vector<Vec3>& positions) {
  const Vec3& a = positions[face[0]];
  return (positions[face[1]] - a).cross(positions[face[2]] - a);
}

bool FoldGuard::hold(const std::vector<Vec3>& before, const std::vector<Vec3>& after, std::vector<char>& held) const {
  const std::vector<Vec3> old_areas = doubled_areas(level_, before), areas = doubled_areas(level_, after);
  bool any = false;
  const auto hold_corners = [&](int face) {
    for (int v : level_.faces[face]) {
      any = any || !held[v];
      held[v] = 1;
    }
  };
  for (int f = 0; f < level_.face_count(); ++f)
    if (!(areas[f].dot(surface_areas_[f]) > 0.0) && old_areas[f].dot(surface_areas_[f]) > 0.0) hold_corners(f);
  for (const std::array<int, 2>& sides : level_.edge_faces) {
    const auto [a, b] = sides;
    if (b < 0 || !folded(areas[a], areas[b]) || folded(old_areas[a], old_areas[b])) continue;
    hold_corners(a);
    hold_corners(b);
  }
  return any;
}

}  // namespace gsp
