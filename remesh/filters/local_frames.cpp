#include "remesh/filters/local_frames.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/fixed_order.h"

namespace gsp {

namespace {

// Faces thinner than that, by the sine of the angle between two edges, count less. Flat parts have some of 1e-16.
constexpr double kThinFace = 1e-4;
// Length of the sum of two unit normals from which on the sum alone counts; of a single one that counts alone.
constexpr double kFoldedEdge = 0.4, kVanishing = 0.3;

/// Unit normal of a face, shorter where the face is thin.
Vec3 steady_normal(const Vec3& ab, const Vec3& ac) {
  const Vec3 normal = cross(ab, ac);
  const double least = kThinFace * std::sqrt(dot(ab, ab) * dot(ac, ac));
  const double length = std::max(std::sqrt(dot(normal, normal)), least);
  return length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
}

/// A vector with some of another one where it is short, so that neither is 0 nor jumps.
Vec3 filled_up(const Vec3& vector, const Vec3& other, double enough) {
  const double length = std::sqrt(dot(vector, vector));
  return length < enough ? Vec3(vector + (1.0 - length / enough) * other) : vector;
}

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

EdgeFrames::EdgeFrames(const SubdivisionLevel& level, const std::vector<Vec3>& positions, FrameRule rule)
    : level_(level), positions_(positions), rule_(rule), normals_(level.faces.size()) {
  for (int f = 0; f < level.face_count(); ++f) {
    const Triangle& t = level.faces[f];
    const Vec3 ab = positions[t[1]] - positions[t[0]], ac = positions[t[2]] - positions[t[0]];
    normals_[f] = rule == FrameRule::Steady ? steady_normal(ab, ac) : unit(cross(ab, ac)).value_or(Vec3::Zero());
  }
}

Frame EdgeFrames::operator()(int e) const {
  const Vec3& first = normals_[level_.edge_faces[e][0]];
  Vec3 normal = first;
  if (level_.edge_faces[e][1] >= 0) normal += normals_[level_.edge_faces[e][1]];
  if (rule_ == FrameRule::Steady) normal = filled_up(filled_up(normal, first, kFoldedEdge), Vec3::UnitZ(), kVanishing);
  return frame(normal, positions_[level_.edges[e][1]] - positions_[level_.edges[e][0]]);
}

}  // namespace gsp
