#include "coder/importance.h"

#include <algorithm>
#include <cmath>

#include "coder/bitplane_coder.h"
#include "mesh/fixed_order.h"
#include "remesh/filters/local_frames.h"

namespace gsp {

namespace {

using Moment = SurfaceUrgency::Moment;

Moment products(const Vec3& v) {
  Moment m;
  m << v.x() * v.x(), v.y() * v.y(), v.z() * v.z(), v.x() * v.y(), v.x() * v.z(), v.y() * v.z();
  return m;
}

double trace(const Moment& m) { return m[0] + m[1] + m[2]; }

/// fᵀ m f.
double along(const Vec3& f, const Moment& m) {
  const Moment p = products(f);
  return ((p[0] * m[0] + p[1] * m[1]) + p[2] * m[2]) + 2.0 * ((p[3] * m[3] + p[4] * m[4]) + p[5] * m[5]);
}

/// kPassesPerPlane·log2(sqrt(ratio)) rounded, by comparisons only.
std::int8_t urgency_of(double ratio) {
  static_assert(kPassesPerPlane == 4);
  if (!(ratio > 1e-30)) return kMinUrgency;
  const auto bits = Eigen::numext::bit_cast<std::uint64_t>(ratio);
  const int exponent = static_cast<int>(bits >> 52) - 1023;
  const std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  // Fractions of 2^1/4 and 2^3/4.
  constexpr std::uint64_t kQuarter = 0x306fe0a31b715, kThreeQuarters = 0xae89f995ad3ad;
  const int half_octaves = 2 * exponent + (mantissa < kQuarter ? 0 : mantissa < kThreeQuarters ? 1 : 2);
  return static_cast<std::int8_t>(std::clamp(half_octaves, kMinUrgency, kMaxUrgency));
}

/// Area times n·nᵀ of a triangle; its trace is the area.
Moment face_moment(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area = cross(b - a, c - a) / 2;
  const double size = std::sqrt(dot(area, area));
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
      const int beyond = level.smooth_face(side, face);
      if (side != e && beyond >= 0) add(beyond);
    }
  }
  return sum / count;
}

}  // namespace

SurfaceUrgency::SurfaceUrgency(const std::vector<SubdivisionLevel>& levels, const EdgeForest& forest,
                               std::vector<std::vector<Vec3>> positions, int tangential_ratio, FrameRule rule)
    : levels_(levels),
      forest_(forest),
      positions_(std::move(positions)),
      least_(1.0 / (tangential_ratio * tangential_ratio)),
      finest_(static_cast<int>(positions_.size()) - 1),
      moments_(finest_) {
  if (finest_ == 0) return;
  moments_[finest_ - 1] = quadrisected_moments(levels[finest_ - 1], positions_[finest_]);
  for (const Moment& m : moments_[finest_ - 1]) total_ += trace(m);
  for (int l = finest_ - 1; l > 0; --l) {
    const std::vector<Moment>& fine = moments_[l];
    for (std::size_t f = 0; f < fine.size(); f += 4)
      moments_[l - 1].push_back(fine[f] + fine[f + 1] + fine[f + 2] + fine[f + 3]);
  }
  for (int l = 0; l < finest_; ++l) frames_.emplace_back(levels[l], positions_[l], rule);
}

std::array<std::int8_t, 3> SurfaceUrgency::of(int node) const {
  if (!(total_ > 0.0 && std::isfinite(total_))) return {0, 0, 0};
  while (node >= forest_.level_begin[finest_]) node = forest_.parent[node];
  int l = 0;
  while (node >= forest_.level_begin[l + 1]) ++l;
  const int e = node - forest_.level_begin[l];
  const Moment m = support_moment(levels_[l], moments_[l], e) * (levels_[l].face_count() / total_);
  const double area = trace(m);
  const Frame frame = frames_[l](e);
  return {urgency_of(area), urgency_of(along(frame.col(1), m) + least_ * area),
          urgency_of(along(frame.col(2), m) + least_ * area)};
}

}  // namespace gsp
