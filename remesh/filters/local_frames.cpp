#include "remesh/filters/local_frames.h"

#include <Eigen/Geometry>

namespace gsp {

namespace {

/// A unit vector orthogonal to the unit vector n.
Vec3 any_orthogonal(const Vec3& n) {
  int smallest = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(n[k]) < std::abs(n[smallest])) smallest = k;
  return n.cross(Vec3::Unit(smallest)).normalized();
}

/// Overflow and underflow of squares count as degenerate.
bool has_direction(const Vec3& v) {
  const double square = v.squaredNorm();
  return square > 1e-300 && square < 1e300;
}

Frame frame(const Vec3& normal, const Vec3& direction) {
  Frame f;
  const Vec3 n = has_direction(normal) ? Vec3(normal.normalized()) : Vec3::UnitZ();
  const Vec3 along = direction - n * n.dot(direction);
  const bool usable = has_direction(along) && along.squaredNorm() > 1e-20 * direction.squaredNorm();
  const Vec3 t = usable ? Vec3(along.normalized()) : any_orthogonal(n);
  f << n, t, n.cross(t);
  return f;
}

}  // namespace

EdgeFrames::EdgeFrames(const SubdivisionLevel& level, const std::vector<Vec3>& positions)
    : level_(level), positions_(positions), normals_(level.faces.size()) {
  for (int f = 0; f < level.face_count(); ++f) {
    const Triangle& t = level.faces[f];
    const Vec3 n = (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
    normals_[f] = has_direction(n) ? Vec3(n.normalized()) : Vec3::Zero();
  }
}

Frame EdgeFrames::operator()(int e) const {
  Vec3 normal = normals_[level_.edge_faces[e][0]];
  if (level_.edge_faces[e][1] >= 0) normal += normals_[level_.edge_faces[e][1]];
  return frame(normal, positions_[level_.edges[e][1]] - positions_[level_.edges[e][0]]);
}

}  // namespace gsp
