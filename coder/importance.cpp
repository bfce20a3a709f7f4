#include "coder/importance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "coder/bitplane_coder.h"
#include "coder/local_frames.h"

namespace gsp {

namespace {

using Moment = Eigen::Matrix3d;

/// kPassesPerPlane·log2(sqrt(ratio)) rounded, by comparisons only.
std::int8_t urgency_of(double ratio) {
  static_assert(kPassesPerPlane == 4);
  if (!(ratio > 1e-30)) return kMinUrgency;
  int exponent = 0;
  const double mantissa = std::frexp(ratio, &exponent);                                 // in [1/2, 1)
  constexpr double kQuarter = 0.5946035575013605, kThreeQuarters = 0.8408964152537145;  // 2^-3/4, 2^-1/4
  const int half_octaves = 2 * exponent - (mantissa < kQuarter ? 2 : mantissa < kThreeQuarters ? 1 : 0);
  return static_cast<std::int8_t>(std::clamp(half_octaves, kMinUrgency, kMaxUrgency));
}

/// Area times n·nᵀ of every face; its trace is the area.
std::vector<Moment> face_moments(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<Moment> moments(level.faces.size());
  for (int f = 0; f < level.face_count(); ++f) {
    const Triangle& t = level.faces[f];
    const Vec3 area = (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]) / 2;
    const double size = area.norm();
    moments[f] = size > 1e-150 ? Moment(area * (area / size).transpose()) : Moment::Zero();
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
      const auto& [f, g] = level.edge_faces[side];
      const int beyond = f == face ? g : f;
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
  std::vector<Moment> moments = face_moments(levels[finest], positions[finest]);
  double total = 0.0;
  for (const Moment& m : moments) total += m.trace();
  if (finest == 0 || !(total > 0.0 && std::isfinite(total))) return urgency;
  const double least = 1.0 / (tangential_ratio * tangential_ratio);
  for (int l = finest; l >= 0; --l) {
    if (l < finest) {
      const std::vector<Frame> frames = edge_frames(levels[l], positions[l]);
      const double scale = levels[l].face_count() / total;
      for (int e = 0; e < levels[l].edge_count(); ++e) {
        const Moment m = support_moment(levels[l], moments, e) * scale;
        const double area = m.trace();
        for (int c = 0; c < 3; ++c) {
          const double along = frames[e].col(c).dot(m * frames[e].col(c));
          urgency[c][forest.level_begin[l] + e] = urgency_of(c == 0 ? area : along + least * area);
        }
      }
    }
    if (l == 0) break;
    for (std::size_t f = 0; f < moments.size() / 4; ++f)
      moments[f] = moments[4 * f] + moments[4 * f + 1] + moments[4 * f + 2] + moments[4 * f + 3];
    moments.resize(moments.size() / 4);
  }
  for (auto& component : urgency)
    for (int n = forest.level_begin[std::clamp(finest, 1, forest.levels())]; n < forest.nodes(); ++n)
      component[n] = component[forest.parent[n]];
  return urgency;
}

}  // namespace gsp
