#include "remesh/filters/local_frames.h"

#include <cmath>
#include <optional>

#include "mesh/fixed_order.h"

namespace gsp {

namespace {

/// A unit vector orthogonal to the unit vector n.
Vec3 any_orthogonal(const Vec3& n) {
  int smallest = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(n[k]) < std::abs(n[smallest])) smallest = k;
  return *unit(cross(n, Vec3::Unit(smallest)));
}

Frame frame(const Vec3& normal, const Vec3& direction) {
  Frame f;
  const Vec3 n = unit(normal).value_or(Vec3::UnitZ());
  const Vec3 along = direction - n * dot(n, direction);
  const std::optional<Vec3> tangent =
      dot(along, along) > 1e-20 * dot(direction, direction) ? unit(along) : std::nullopt;
  const Vec3 t = tangent ? *tangent : any_orthogonal(n);
  f << n, t, cross(n, t);
  return f;
}

}  // namespace

EdgeFrames::EdgeFrames(const SubdivisionLevel& level, const std::vector<Vec3>& positions)
    : level_(level), positions_(positions), normals_(level.faces.size()) {
  for (int f = 0; f < level.face_count(); ++f) {
    const Triangle& t = level.faces[f];
    normals_[f] =
        unit(cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]])).value_or(Vec3::Zero());
  }
}

Frame EdgeFrames::operator()(int e) const {
  Vec3 normal = normals_[level_.edge_faces[e][0]];
  if (level_.edge_faces[e][1] >= 0) normal += normals_[level_.edge_faces[e][1]];
  return frame(normal, positions_[level_.edges[e][1]] - positions_[level_.edges[e][0]]);
}

}  // namespace gsp
