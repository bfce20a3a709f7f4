#include "coder/importance.h"

#include <algorithm>
#include <cmath>

#include "coder/bitplane_coder.h"

namespace gsp {

namespace {

/// kPassesPerPlane·log2(sqrt(ratio)) rounded, by comparisons only.
std::int8_t urgency_of(double ratio) {
  static_assert(kPassesPerPlane == 4);
  int exponent = 0;
  const double mantissa = std::frexp(ratio, &exponent);                                 // in [1/2, 1)
  constexpr double kQuarter = 0.5946035575013605, kThreeQuarters = 0.8408964152537145;  // 2^-3/4, 2^-1/4
  const int half_octaves = 2 * exponent - (mantissa < kQuarter ? 2 : mantissa < kThreeQuarters ? 1 : 0);
  return static_cast<std::int8_t>(std::clamp(half_octaves, -kMaxUrgency, kMaxUrgency));
}

std::vector<double> face_areas(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  const Mesh mesh{positions, level.faces};
  std::vector<double> areas(level.faces.size());
  for (int f = 0; f < level.face_count(); ++f) areas[f] = face_area(mesh, f);
  return areas;
}

}  // namespace

std::vector<std::int8_t> area_urgency(const std::vector<SubdivisionLevel>& levels, const EdgeForest& forest,
                                      const std::vector<Vec3>& positions) {
  std::vector<std::int8_t> urgency(forest.nodes(), 0);
  const int finest = std::min(kAreaLevel, forest.levels());
  std::vector<double> areas = face_areas(levels[finest], positions);
  double total = 0.0;
  for (double a : areas) total += a;
  if (!(total > 0.0 && std::isfinite(total))) return urgency;
  for (int l = finest; l >= 0; --l) {
    if (l < forest.levels())
      for (int e = 0; e < levels[l].edge_count(); ++e) {
        const auto [f, g] = levels[l].edge_faces[e];
        const double mean = g < 0 ? areas[f] : (areas[f] + areas[g]) / 2;
        urgency[forest.level_begin[l] + e] = urgency_of(mean * levels[l].face_count() / total);
      }
    if (l == 0) break;
    for (std::size_t f = 0; f < areas.size() / 4; ++f)
      areas[f] = areas[4 * f] + areas[4 * f + 1] + areas[4 * f + 2] + areas[4 * f + 3];
    areas.resize(areas.size() / 4);
  }
  for (int n = forest.level_begin[std::min(finest + 1, forest.levels())]; n < forest.nodes(); ++n)
    urgency[n] = urgency[forest.parent[n]];
  return urgency;
}

}  // namespace gsp
