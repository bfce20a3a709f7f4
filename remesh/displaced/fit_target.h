#pragma once

#include <vector>

#include "remesh/closest_fit.h"
#include "remesh/nearest_place.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Points for which one thread looks for the nearest places at a time.
inline constexpr std::size_t kSearchBlock = 4096;

/// The surface that a remesh is fitted to, as a sampled remesh of some levels more: coarse vertices have the same
/// numbers in both.
struct FitTarget {
  const SubdivisionLevel& level;
  const std::vector<Vec3>& positions;

  /// Its vertices, each with its place by the map on the remesh's finest level, `extra` levels coarser. Weights sum to
  /// one over a face of that.
  std::vector<SurfaceSample> samples(int extra) const;
  /// #V of the remesh, its vertices' own places.
  std::vector<LevelPlace> vertex_places(int vertex_count) const;

  /// Of a point beside the surface: the unit normal there, or the way to it at its edges and vertices; nothing where
  /// neither has a direction.
  std::optional<Vec3> direction(const LevelPlace& place, const Vec3& point) const;
};

/// The same for a level of any mesh.
std::optional<Vec3> direction_at(const SubdivisionLevel& level, const std::vector<Vec3>& positions,
                                 const LevelPlace& place, const Vec3& point);

/// #V, the length of the longest edge at each vertex of a level; `positions` may have more vertices. O(E).
std::vector<double> longest_edges(const SubdivisionLevel& level, const std::vector<Vec3>& positions);

}  // namespace gsp
