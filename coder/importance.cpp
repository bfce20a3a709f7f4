#include "coder/importance.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Geometry>

#include "coder/bitplane_coder.h"
#include "coder/local_frames.h"

namespace gsp {

namespace {

/// A symmetric matrix: xx, yy, zz, xy, xz, yz.
using Moment = Eigen::Matrix<double, 6, 1>;

Moment products(const Vec3& v) {
  Moment m;
  m << v.x() * v.x(), v.y() * v.y(), v.z() * v.z(), v.x() * v.y(), v.x() * v.z(), v.y() * v.z();
  return m;
}

double trace(const Moment& m) { return m[0] + m[1] + m[2]; }

/// fᵀ m f.
double along(const Vec3& f, const Moment& m) {
  const Moment p = products(f);
  return p.head<3>().dot(m.head<3>()) + 2.0 * p.tail<3>().dot(m.tail<3>());
}

/// kPassesPerPlane·log2(sqrt(ratio)) rounded, by comparisons only.
std::int8_t urgency_of(double ratio) {
  static_assert(kPassesPerPlane == 4);
  if (!(ratio > 1e-30)) return kMinUrgency;
  const auto bits = std::bit_cast<std::uint64_t>(ratio);
  const int exponent = static_cast<int>(bits >> 52) - 1023;
  const std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  // Fractions of 2^1/4 and 2^3/4.
  constexpr std::uint64_t kQuarter = 0x306fe0a31b715, kThreeQuarters = 0xae89f995ad3ad;
  const int half_octaves = 2 * exponent + (mantissa < kQuarter ? 0 : mantissa < kThreeQuarters ? 1 : 2);
  return static_cast<std::int8_t>(std::clamp(half_octaves, kMinUrgency, kMaxUrgency));
}

/// Area times n·nᵀ of a triangle; its trace is the area.
Moment face_moment(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area = (b - a).cross(c - a) / 2;
  const double size = area.norm();
  return size > 1e-150 ? Moment(products(area) / size) : Moment::Zero();
}

/// Of each face, the moments of the four that it is quadrisected into. `positions` are those of the next level.
std::vector<Moment> quadrisected_moments(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<Moment> moments(level.faces.size());
  for (int f = 0; f < level.face_count(); ++f) {
    std::array<Vec3, 3> corners, middles;
    for (int k = 0; k < 3; ++k) {
      corners[k] = positions[level.faces[f][k]];
      middles[k] = positions[level.vertex_count + level.face_edges[f][k]];
    }
    moments[f] = face_moment(middles[0], middles[1], middles[2]);
    for (int k = 0; k < 3; ++k) moments[f] += face_moment(corners[k], middles[k], middles[(k + 2) % 3]);
  }
  return moments;
}

/// Mean moment per face over the support of an edge's detail: its own faces and those beside them.
Moment support_moment(const SubdivisionLevel& level, const std::vector<Moment>& moments, int e) {
  Moment sum = Moment::Zero();
  int count = 0;
  const auto add = [&](int face) {
    sum += moments[face];
    ++count;
  };
  for (int face : level.edge_faces[e]) {
    if (face < 0) continue;
    add(face);
    for (int side : level.face_edges[face]) {
      const int beyond = level.other_face(side, face);
      if (side != e && beyond >= 0) add(beyond);
    }
  }
  return sum / count;
}

}  // namespace

ComponentUrgency surface_urgency(const std::vector<SubdivisionLevel>& levels, const EdgeForest& forest,
                                 const std::vector<std::vector<Vec3>>& positions, int tangential_ratio) {
  ComponentUrgency urgency;
  for (auto& component : urgency) component.assign(forest.nodes(), 0);
  const int finest = static_cast<int>(positions.size()) - 1;
  if (finest == 0) return urgency;
  std::vector<Moment> moments = quadrisected_moments(levels[finest - 1], positions[finest]);
  double total = 0.0;
  for (const Moment& m : moments) total += trace(m);
  if (!(total > 0.0 && std::isfinite(total))) return urgency;
  const double least = 1.0 / (tangential_ratio * tangential_ratio);
  for (int l = finest - 1; l >= 0; --l) {
    const EdgeFrames frames(levels[l], positions[l]);
    const double scale = levels[l].face_count() / total;
    for (int e = 0; e < levels[l].edge_count(); ++e) {
      const Moment m = support_moment(levels[l], moments, e) * scale;
      const double area = trace(m);
      const int n = forest.level_begin[l] + e;
      urgency[0][n] = urgency_of(area);
      const Frame frame = frames(e);
      for (int c = 1; c < 3; ++c) urgency[c][n] = urgency_of(along(frame.col(c), m) + least * area);
    }
    if (l == 0) break;
    for (std::size_t f = 0; f < moments.size() / 4; ++f)
      moments[f] = moments[4 * f] + moments[4 * f + 1] + moments[4 * f + 2] + moments[4 * f + 3];
    moments.resize(moments.size() / 4);
  }
  for (auto& component : urgency)
    for (int n = forest.level_begin[finest]; n < forest.nodes(); ++n) component[n] = component[forest.parent[n]];
  return urgency;
}

}  // namespace gsp
