#include "remesh/displaced/displaced_remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "mesh/error.h"
#include "mesh/nearest/triangle_tree.h"
#include "mesh/parallel.h"
#include "remesh/displaced/control_fit.h"
#include "remesh/displaced/displacement_fit.h"
#include "remesh/displaced/patch_care.h"
#include "remesh/fold_guard.h"

namespace gsp {

namespace {

/// A control mesh, its surface and what is left between that and the target.
struct Attempt {
  std::vector<Vec3> control;
  SmoothSurface surface;
  Displacements displacements;
  int missed = 0;
  std::vector<double> errors;  ///< #F of the base, mean squared distance, in the worse direction
  double error = std::numeric_limits<double>::infinity();
};

/// Weighted means over base faces.
class PatchMeans {
 public:
  explicit PatchMeans(int patches) : sums_(patches, 0.0), weights_(patches, 0.0) {}
  void add(int patch, double weight, double value) {
    sums_[patch] += weight * value;
    weights_[patch] += weight;
  }
  /// On coarse levels a patch may have no sample.
  double mean(std::size_t patch) const { return weights_[patch] > 0.0 ? sums_[patch] / weights_[patch] : 0.0; }
  double sum(const std::vector<double>& areas) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < areas.size(); ++p) sum += areas[p] * mean(p);
    return sum;
  }

 private:
  std::vector<double> sums_, weights_;
};

/// #points, the squared distance of each to a surface.
std::vector<double> squared_distances(const TriangleTree& surface, const std::vector<Vec3>& points) {
  std::vector<double> squared(points.size());
  parallel_for(points.size(), kSearchBlock, [&](std::size_t begin, std::size_t end) {
    squared_distances(surface, points.data() + begin, end - begin, squared.data() + begin);
  });
  return squared;
}

class DisplacedRemesher {
 public:
  /// `unit`: power of two that coordinates are divided by, so that no square over- or underflows.
  DisplacedRemesher(const SemiregularMesh& surface, int level, const DisplacedOptions& options, double unit)
      : options_(options), unit_(unit), all_levels_(levels_of(surface)), extra_(surface.level - level) {
    levels_.assign(all_levels_.begin(), all_levels_.begin() + level + 1);
    for (const Vec3& p : surface.positions) dense_.push_back(p / unit);
    measure_areas();
    grid_ =
        control_grid_below(bounding_box_diagonal({dense_, all_levels_.back().faces}) / std::exp2(options.control_bits));
  }

  SemiregularMesh run(Progress& progress) {
    constexpr int kMostRounds = 6;
    const FitTarget target{all_levels_.back(), dense_};
    const TriangleTree target_tree({dense_, all_levels_.back().faces});
    const ControlMap map(levels_);
    PatchCare care(levels_.front().vertex_count, levels_.front().faces, areas_);
    Attempt best;
    for (int round = 0; round < kMostRounds; ++round) {
      progress.report("displaced remesh", static_cast<double>(round) / kMostRounds);
      Attempt attempt = try_once(map, target, target_tree, care.now());
      const bool done = !care.learn(attempt.errors);
      if (attempt.error < best.error) best = std::move(attempt);
      if (done) break;
    }
    if (best.missed > 0)
      progress.note(std::to_string(best.missed) + " of " + std::to_string(levels_.back().vertex_count) +
                    " vertices of the displaced remesh see no surface along their normals and were filled in");
    return result(std::move(best));
  }

 private:
  static std::vector<SubdivisionLevel> levels_of(const SemiregularMesh& mesh) {
    return subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level);
  }
  void measure_areas() {
    const SubdivisionLevel& level = all_levels_.back();
    areas_.assign(levels_.front().face_count(), 0.0);
    const int shift = 2 * static_cast<int>(all_levels_.size() - 1);
    double sum = 0.0;
    for (int f = 0; f < level.face_count(); ++f) {
      const double area = doubled_area(level.faces[f], dense_).norm();
      areas_[f >> shift] += area;
      sum += area;
    }
    for (double& area : areas_) area /= sum;
  }

  const SubdivisionLevel& finest() const { return levels_.back(); }

  /// `care`: #F of the base, as PatchCare says.
  Attempt try_once(const ControlMap& map, const FitTarget& target, const TriangleTree& target_tree,
                   const std::vector<int>& care) const {
    // Small beside 1, the weight of the distance itself; more where that is too little.
    constexpr std::array<double, PatchCare::kMost + 1> kStiffness = {0.01, 0.01, 0.1, 1.0};
    ControlFitOptions control_options;
    std::vector<char> watched;
    for (int c : care) {
      control_options.stiffness.push_back(kStiffness[c]);
      watched.push_back(c > 0);
    }
    Attempt attempt;
    std::vector<SurfaceSample> samples = target.samples(extra_);
    const std::vector<SurfaceSample> by_map = samples;
    attempt.control = fit_control(map, levels_, target, control_options, samples);
    for (Vec3& p : attempt.control)
      for (double& x : p) x = grid_ * std::nearbyint(x / grid_);
    attempt.surface = smooth_surface(levels_, attempt.control);
    if (options_.positions == Positions::Sampled) {
      PiercedDisplacements pierced = pierce_target(levels_, attempt.surface, target);
      attempt.displacements = std::move(pierced.displacements);
      attempt.missed = pierced.missed;
    } else {
      attempt.displacements =
          displacements_of(levels_, attempt.surface, fitted_positions(attempt.surface, target, watched, samples));
    }
    measure(attempt, target_tree, by_map);
    return attempt;
  }

  std::vector<Vec3> fitted_positions(const SmoothSurface& surface, const FitTarget& target,
                                     const std::vector<char>& watched, std::vector<SurfaceSample>& samples) const {
    // First with room to move, then near the least on the normals alone: with a hundredth of the last weight the part
    // along the surface, which is dropped in the end, costs 0.4 dB of the horse's ceiling.
    const DisplacementFitOptions first{1e-2, 0.02, 1.0, 4, 0.5, 0.03, watched};
    DisplacementFitOptions then{5e-3, 0.01, 0.25, 10, 50.0, 0.03, watched};
    if (options_.positions == Positions::Closest) then.stiffness /= 10.0;
    std::vector<Vec3> moves(surface.points.size(), Vec3::Zero());
    moves = fit_displacements(levels_, surface, target, first, samples, moves);
    moves = fit_displacements(levels_, surface, target, then, samples, moves);
    for (std::size_t v = 0; v < moves.size(); ++v) moves[v] += surface.points[v];
    return moves;
  }

  /// The mean squared distance over each base face and over all, in the worse of both directions: few vertices that lie
  /// off the surface can weigh more in a remesh's error than all of the surface's distance from it.
  void measure(Attempt& attempt, const TriangleTree& target_tree, const std::vector<SurfaceSample>& by_map) const {
    const std::vector<Vec3> points = displaced_points(levels_, attempt.surface, attempt.displacements);
    const int shift = 2 * static_cast<int>(levels_.size() - 1);
    PatchMeans forward(levels_.front().face_count()), backward = forward;
    const std::vector<double> there = squared_distances(TriangleTree({points, finest().faces}), dense_);
    for (std::size_t i = 0; i < by_map.size(); ++i)
      forward.add(by_map[i].place.face >> shift, by_map[i].weight, there[i]);
    // Of the remesh its edges' midpoints, weighed by the area beside them: faces that jut out are large.
    std::vector<Vec3> middles;
    for (const auto& [a, b] : finest().edges) middles.push_back(0.5 * (points[a] + points[b]));
    const std::vector<double> back = squared_distances(target_tree, middles);
    for (int e = 0; e < finest().edge_count(); ++e)
      for (int f : finest().edge_faces[e])
        if (f >= 0) backward.add(f >> shift, doubled_area(finest().faces[f], points).norm(), back[e]);
    attempt.errors.resize(levels_.front().face_count());
    for (std::size_t f = 0; f < attempt.errors.size(); ++f)
      attempt.errors[f] = std::max(forward.mean(f), backward.mean(f));
    attempt.error = std::max(forward.sum(areas_), backward.sum(areas_));
  }

  SemiregularMesh result(Attempt attempt) const {
    SemiregularMesh mesh{static_cast<int>(levels_.size()) - 1, levels_.front().vertex_count, levels_.front().faces,
                         displaced_points(levels_, attempt.surface, attempt.displacements)};
    for (Vec3& p : mesh.positions) p *= unit_;
    for (Vec3& p : attempt.control) p *= unit_;
    mesh.control = {std::move(attempt.control), unit_ * grid_};
    return mesh;
  }

  const DisplacedOptions options_;
  const double unit_;
  const std::vector<SubdivisionLevel> all_levels_;
  std::vector<SubdivisionLevel> levels_;  ///< of the remesh
  const int extra_;
  std::vector<Vec3> dense_;
  std::vector<double> areas_;  ///< #F of the base, of the target's patches over that of all
  double grid_ = 0.0;
};

}  // namespace

double control_grid_below(double step) {
  int exponent = 0;
  const double mantissa = std::frexp(step, &exponent);
  return std::ldexp(std::floor(8.0 * mantissa), exponent - 3);
}

SemiregularMesh displaced_remesh(const SemiregularMesh& surface, int level, const DisplacedOptions& options,
                                 Progress& progress) {
  if (level < 0 || level > surface.level)
    throw Error(Cause::BadOption, "a displaced remesh has at most the levels of what it is fitted to");
  if (options.control_bits < 4 || options.control_bits > 24)
    throw Error(Cause::BadOption, "control_bits " + std::to_string(options.control_bits) + " is not in 4..24");
  const double diagonal = bounding_box_diagonal(surface.mesh());
  if (!(diagonal > 0.0)) throw Error(Cause::NoArea, "a surface without extent cannot be displaced to");
  return DisplacedRemesher(surface, level, options, std::exp2(std::ilogb(diagonal))).run(progress);
}

}  // namespace gsp
