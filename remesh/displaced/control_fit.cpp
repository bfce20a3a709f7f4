#include "remesh/displaced/control_fit.h"

#include "mesh/fixed_order.h"
#include "mesh/parallel.h"
#include "remesh/displaced/line_walk.h"

namespace gsp {

namespace {

/// Of each control point, relative to samples that weigh one over a face: enough for equations without a solution of
/// their own to have one.
constexpr double kTether = 1e-9;
class ControlFit {
 public:
  ControlFit(const ControlMap& map, const std::vector<SubdivisionLevel>& levels, const FitTarget& target,
             const ControlFitOptions& options, std::vector<SurfaceSample>& samples)
      : map_(map),
        levels_(levels),
        finest_(levels.back()),
        target_(target),
        options_(options),
        by_map_(samples),
        samples_(samples),
        control_(target.positions.begin(), target.positions.begin() + levels.front().vertex_count),
        vertex_face_(finest_.vertex_count),
        places_(target.vertex_places(finest_.vertex_count)),
        target_boundary_(target.level) {
    const std::vector<VertexFan> fans = vertex_fans(finest_);
    for (int v = 0; v < finest_.vertex_count; ++v) {
      if (fans[v].sharp_count != 2) continue;
      const auto [a, b] = fans[v].sharp_edges;
      boundary_.push_back({finest_.other_end(a, v), v, finest_.other_end(b, v)});
    }
    for (int f = 0; f < finest_.face_count(); ++f)
      for (int k = 0; k < 3; ++k) vertex_face_[finest_.faces[f][k]] = {f, k};
  }

  std::vector<Vec3> run() {
    to_the_maps_points();
    for (int round = 0; round < options_.rounds; ++round) to_the_nearest_points();
    return control_;
  }

 private:
  void move(const ControlSystem& system) {
    const std::vector<Vec3> moves = system.solve(kTether);
    for (std::size_t b = 0; b < control_.size(); ++b) control_[b] += moves[b];
  }

  /// Adds the distance of a sample from its place by the map.
  void add_by_map(ControlSystem& system, const std::vector<Vec3>& points, std::size_t i, double weight) const {
    const SurfaceSample& s = by_map_[i];
    const Vec3 gap = s.point - s.place.at(finest_, points);
    system.add(s.place.face, s.place.weights, weight * Eigen::Matrix3d::Identity(), weight * gap);
  }

  void to_the_maps_points() {
    ControlSystem system(map_, levels_);
    const std::vector<Vec3> points = map_.points(control_);
    for (std::size_t i = 0; i < by_map_.size(); ++i) add_by_map(system, points, i, by_map_[i].weight);
    move(system);
  }

  void to_the_nearest_points() {
    ControlSystem system(map_, levels_);
    const std::vector<Vec3> points = map_.points(control_);
    parallel_for(samples_.size(), kSearchBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) walk_to_nearest(finest_, points, samples_[i].point, samples_[i].place);
    });
    parallel_for(places_.size(), kSearchBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        walk_to_nearest(target_.level, target_.positions, points[v], places_[v]);
    });
    const int patch_shift = 2 * static_cast<int>(levels_.size() - 1);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const SurfaceSample& s = samples_[i];
      const auto normal = direction_at(finest_, points, s.place, s.point);
      if (!normal) continue;
      const double gap = normal->dot(s.point - s.place.at(finest_, points));
      system.add(s.place.face, s.place.weights, s.weight * *normal * normal->transpose(), s.weight * gap * *normal);
      add_by_map(system, points, i, s.weight * options_.stiffness[by_map_[i].place.face >> patch_shift]);
    }
    for (std::size_t v = 0; v < places_.size(); ++v) {
      const auto normal = target_.direction(places_[v], points[v]);
      if (!normal) continue;
      const double gap = normal->dot(places_[v].at(target_.level, target_.positions) - points[v]);
      std::array<double, 3> corner = {0.0, 0.0, 0.0};
      corner[vertex_face_[v].second] = 1.0;
      system.add(vertex_face_[v].first, corner, *normal * normal->transpose(), gap * *normal);
    }
    add_boundary(system, points);
    move(system);
  }

  /// Adds the distances of boundary vertices from the target's boundary, across the curve: what lies beyond it no
  /// normal brings back.
  void add_boundary(ControlSystem& system, const std::vector<Vec3>& points) const {
    // Against 3 for what is at a vertex inside: without it the bunny's remesh ends at 71 dB, with it at 79
    // (bench/README.md, Displaced meshes).
    constexpr double kBoundary = 10.0;
    for (const auto& [before, v, after] : boundary_) {
      const auto tangent = unit(points[after] - points[before]);
      if (!tangent) continue;
      const Vec3 nearest =
          target_boundary_.to_plane(target_.positions, v, points[v], *tangent).value_or(target_.positions[v]);
      const Eigen::Matrix3d form = kBoundary * (Eigen::Matrix3d::Identity() - *tangent * tangent->transpose());
      std::array<double, 3> corner = {0.0, 0.0, 0.0};
      corner[vertex_face_[v].second] = 1.0;
      system.add(vertex_face_[v].first, corner, form, form * (nearest - points[v]));
    }
  }

  const ControlMap& map_;
  const std::vector<SubdivisionLevel>& levels_;
  const SubdivisionLevel& finest_;
  const FitTarget& target_;
  const ControlFitOptions& options_;
  const std::vector<SurfaceSample> by_map_;
  std::vector<SurfaceSample>& samples_;
  std::vector<Vec3> control_;
  std::vector<std::pair<int, int>> vertex_face_;  ///< #V, a face and which of its corners the vertex is
  std::vector<LevelPlace> places_;                ///< #V, nearest places of the limit surface's vertices on the target
  const BoundaryWalk target_boundary_;
  std::vector<std::array<int, 3>> boundary_;  ///< vertices with two boundary edges between the ones beside them
};

}  // namespace

std::vector<Vec3> fit_control(const ControlMap& map, const std::vector<SubdivisionLevel>& levels,
                              const FitTarget& target, const ControlFitOptions& options,
                              std::vector<SurfaceSample>& samples) {
  return ControlFit(map, levels, target, options, samples).run();
}

}  // namespace gsp
