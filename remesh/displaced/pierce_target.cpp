#include <algorithm>

#include "mesh/fixed_order.h"
#include "remesh/displaced/displacement_fit.h"
#include "remesh/displaced/line_walk.h"

namespace gsp {

namespace {

class Piercer {
 public:
  Piercer(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface, const FitTarget& target)
      : levels_(levels),
        finest_(levels.back()),
        surface_(surface),
        target_(target),
        by_map_(displacements_of(levels, surface, target_points())) {
    on_surface_.assign(finest_.vertex_count, 0);
  }

  PiercedDisplacements run() {
    result_ = by_map_;
    pierce_boundary();
    pierce_inside();
    keep_upright();
    const auto missed = std::count(on_surface_.begin(), on_surface_.end(), 0);
    if (missed > 0) fill();
    return {std::move(result_), static_cast<int>(missed)};
  }

 private:
  std::vector<Vec3> target_points() const {
    return {target_.positions.begin(), target_.positions.begin() + finest_.vertex_count};
  }

  bool on_boundary(int v) const { return !surface_.conormals[v].isZero(0.0); }

  void pierce_boundary() {
    const BoundaryWalk boundary(target_.level);
    for (int v = 0; v < finest_.vertex_count; ++v) {
      if (!on_boundary(v)) continue;
      on_surface_[v] = 1;
      // The plane that holds normal and conormal cuts the boundary once near the map's point.
      const Vec3 tangent = cross(surface_.normals[v], surface_.conormals[v]);
      if (const auto hit = boundary.to_plane(target_.positions, v, surface_.points[v], tangent)) {
        result_.along[v] = dot(surface_.normals[v], *hit - surface_.points[v]);
        result_.across[v] = dot(surface_.conormals[v], *hit - surface_.points[v]);
      }
    }
  }

  void pierce_inside() {
    constexpr double kAperture = 3.0;
    const std::vector<double> spacing = longest_edges(finest_, target_.positions);
    const std::vector<LevelPlace> places = target_.vertex_places(finest_.vertex_count);
    const std::vector<Vec3> moves = moves_across(levels_, surface_, result_.across);
    for (int v = 0; v < finest_.vertex_count; ++v) {
      if (on_boundary(v)) continue;
      const Vec3 origin = surface_.points[v] + moves[v];
      const auto along = walk_to_line(target_.level, target_.positions, places[v].face, origin, surface_.normals[v]);
      if (!along) continue;
      const Vec3 hit = origin + *along * surface_.normals[v];
      if (!((hit - target_.positions[v]).norm() <= kAperture * spacing[v])) continue;
      result_.along[v] = *along;
      on_surface_[v] = 1;
    }
  }

  /// Gives up the corners of faces that turn against the target's, and of those that this turns.
  void keep_upright() {
    // A face counts as turned from 84 degrees on.
    constexpr double kCosine = 0.1;
    constexpr int kPasses = 3;
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::vector<Vec3> points = displaced_points(levels_, surface_, result_);
      for (const Triangle& t : finest_.faces) {
        const Vec3 here = doubled_area(t, points), there = doubled_area(t, target_.positions);
        if (here.dot(there) > kCosine * here.norm() * there.norm()) continue;
        for (int v : t)
          if (!on_boundary(v)) on_surface_[v] = 0;
      }
    }
  }

  /// A smooth membrane over the vertices that miss the surface, from where the map has them.
  void fill() {
    constexpr int kRounds = 60;
    std::vector<double>& along = result_.along;
    for (std::size_t v = 0; v < along.size(); ++v)
      if (!on_surface_[v]) along[v] = by_map_.along[v];
    for (int round = 0; round < kRounds; ++round) {
      std::vector<double> sum(along.size(), 0.0);
      std::vector<int> count(along.size(), 0);
      for (const auto& [a, b] : finest_.edges) {
        sum[a] += along[b];
        sum[b] += along[a];
        ++count[a];
        ++count[b];
      }
      for (std::size_t v = 0; v < along.size(); ++v)
        if (!on_surface_[v] && count[v] > 0) along[v] = sum[v] / count[v];
    }
  }

  const std::vector<SubdivisionLevel>& levels_;
  const SubdivisionLevel& finest_;
  const SmoothSurface& surface_;
  const FitTarget& target_;
  const Displacements by_map_;  ///< the parts, along normals and conormals, of the way to the map's points
  Displacements result_;
  std::vector<char> on_surface_;
};

}  // namespace

PiercedDisplacements pierce_target(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                                   const FitTarget& target) {
  return Piercer(levels, surface, target).run();
}

}  // namespace gsp
