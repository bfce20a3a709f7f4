#include "remesh/displaced/fit_target.h"

#include <algorithm>

#include "mesh/fixed_order.h"
#include "remesh/lattice_corners.h"

namespace gsp {

std::vector<SurfaceSample> FitTarget::samples(int extra) const {
  const int steps = 1 << extra;
  std::vector<int> faces_around(level.vertex_count, 0);
  for (const Triangle& t : level.faces)
    for (int v : t) ++faces_around[v];
  std::vector<SurfaceSample> samples(level.vertex_count);
  for (int f = 0; f < level.face_count(); ++f) {
    const auto corners = lattice_corners(extra, f & (steps * steps - 1));
    for (int k = 0; k < 3; ++k) {
      const int v = level.faces[f][k];
      const double second = static_cast<double>(corners[k][0]) / steps;
      const double third = static_cast<double>(corners[k][1]) / steps;
      samples[v] = {positions[v],
                    faces_around[v] / (3.0 * steps * steps),
                    {f >> (2 * extra), {1.0 - second - third, second, third}}};
    }
  }
  return samples;
}

std::vector<LevelPlace> FitTarget::vertex_places(int vertex_count) const {
  std::vector<LevelPlace> places(vertex_count);
  for (int f = 0; f < level.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      if (const int v = level.faces[f][k]; v < vertex_count) {
        places[v].face = f;
        places[v].weights = {0.0, 0.0, 0.0};
        places[v].weights[k] = 1.0;
      }
  return places;
}

std::optional<Vec3> FitTarget::direction(const LevelPlace& place, const Vec3& point) const {
  return direction_at(level, positions, place, point);
}

std::optional<Vec3> direction_at(const SubdivisionLevel& level, const std::vector<Vec3>& positions,
                                 const LevelPlace& place, const Vec3& point) {
  if (!place.inside_face()) return unit(point - place.at(level, positions));
  const auto& [a, b, c] = level.faces[place.face];
  return unit(cross(positions[b] - positions[a], positions[c] - positions[a]));
}

std::vector<double> longest_edges(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<double> longest(level.vertex_count, 0.0);
  for (const auto& [a, b] : level.edges) {
    const double length = (positions[a] - positions[b]).norm();
    longest[a] = std::max(longest[a], length);
    longest[b] = std::max(longest[b], length);
  }
  return longest;
}

}  // namespace gsp
