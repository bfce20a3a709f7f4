#include "coder/local_frames.h"

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

std::vector<Frame> edge_frames(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<Vec3> normals(level.faces.size());
  for (int f = 0; f < level.face_count(); ++f) {
    const Triangle& t = level.faces[f];
    const Vec3 n = (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]);
    normals[f] = has_direction(n) ? Vec3(n.normalized()) : Vec3::Zero();
  }
  std::vector<Frame> frames;
  frames.reserve(level.edges.size());
  for (int e = 0; e < level.edge_count(); ++e) {
    Vec3 normal = normals[level.edge_faces[e][0]];
    if (level.edge_faces[e][1] >= 0) normal += normals[level.edge_faces[e][1]];
    frames.push_back(frame(normal, positions[level.edges[e][1]] - positions[level.edges[e][0]]));
  }
  return frames;
}

}  // namespace gsp
