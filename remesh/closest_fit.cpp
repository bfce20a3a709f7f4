#include "remesh/closest_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"
#include "remesh/vertex_system.h"

namespace gsp {

namespace {

/// To where each vertex was, in the samples' weight: moves along a plane, which no sample minds, stay zero.
constexpr double kTether = 1e-4;

class ClosestFit {
 public:
  ClosestFit(const SubdivisionLevel& finest, const FoldGuard& guard, std::vector<SurfaceSample>& samples,
             const FitEffort& effort, std::vector<Vec3> start)
      : finest_(finest),
        guard_(guard),
        samples_(samples),
        effort_(effort),
        start_(std::move(start)),
        positions_(start_),
        free_(start_.size(), 1),
        squared_(samples.size(), 0.0) {
    for (int e = 0; e < finest.edge_count(); ++e)
      if (finest.edge_faces[e][1] < 0)
        for (int v : finest.edges[e]) free_[v] = 0;
  }

  const std::vector<Vec3>& run() {
    // Relative to coordinates up to 1: mean squares below are rounding.
    constexpr double kRounding = 1e-30;
    double energy = energy_at(positions_);
    for (int round = 0; round < effort_.most_rounds && energy > kRounding * finest_.face_count(); ++round) {
      const double before = energy;
      if (!step(energy) || energy > (1.0 - effort_.enough) * before) break;
    }
    return positions_;
  }

 private:
  /// Also moves the samples to their nearest places there.
  double energy_at(const std::vector<Vec3>& positions) {
    constexpr std::size_t kBlock = 4096;
    parallel_for(samples_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        squared_[i] = walk_to_nearest(finest_, positions, samples_[i].point, samples_[i].place);
    });
    double sum = 0.0;
    for (std::size_t i = 0; i < squared_.size(); ++i) sum += samples_[i].weight * squared_[i];
    for (const auto& [a, b] : finest_.edges)
      sum += effort_.stiffness * (positions[a] - start_[a] - positions[b] + start_[b]).squaredNorm();
    for (std::size_t v = 0; v < positions.size(); ++v) sum += kTether * (positions[v] - start_[v]).squaredNorm();
    return sum;
  }

  /// The distance from the samples' places to second order: exact to the first, and of the second what a plane has.
  VertexSystem linearized() const {
    VertexSystem system(finest_, free_);
    for (const SurfaceSample& sample : samples_) {
      const Triangle& t = finest_.faces[sample.place.face];
      const Vec3 gap = sample.point - sample.place.at(finest_, positions_);
      Vec3 normal = sample.place.inside_face() ? doubled_area(t, positions_) : gap;
      const double length = normal.norm();
      if (!(length > 0.0)) continue;
      normal /= length;
      system.add(sample.place.face, sample.place.weights, sample.weight * normal * normal.transpose(),
                 sample.weight * gap.dot(normal) * normal);
    }
    for (int e = 0; e < finest_.edge_count(); ++e) {
      const auto [a, b] = finest_.edges[e];
      system.add_spring(e, effort_.stiffness,
                        -effort_.stiffness * (positions_[a] - start_[a] - positions_[b] + start_[b]));
    }
    for (std::size_t v = 0; v < positions_.size(); ++v)
      system.add_spring_to_place(static_cast<int>(v), kTether, -kTether * (positions_[v] - start_[v]));
    return system;
  }

  /// The positions that a part of the moves leads to, less of it or nothing where faces would fold.
  std::vector<Vec3> guarded(const std::vector<Vec3>& moves, double part) const {
    constexpr int kHalvings = 3;
    std::vector<double> parts(moves.size(), part);
    std::vector<Vec3> moved(moves.size());
    for (int pass = 0;; ++pass) {
      for (std::size_t v = 0; v < moves.size(); ++v) moved[v] = positions_[v] + parts[v] * moves[v];
      std::vector<char> held(moves.size(), 0);
      if (!guard_.hold(positions_, moved, held)) return moved;
      for (std::size_t v = 0; v < moves.size(); ++v)
        if (held[v]) parts[v] = pass < kHalvings ? 0.5 * parts[v] : 0.0;
    }
  }

  /// False where no part of the step lowers the energy.
  bool step(double& energy) {
    constexpr double kShortest = 0.1;
    const std::vector<Vec3> moves = linearized().solve();
    for (double part = 1.0; part > kShortest; part /= 2.0) {
      const std::vector<Vec3> moved = guarded(moves, part);
      const double energy_there = energy_at(moved);
      if (!(energy_there < energy)) continue;
      energy = energy_there;
      positions_ = moved;
      return true;
    }
    return false;
  }

  const SubdivisionLevel& finest_;
  const FoldGuard& guard_;
  std::vector<SurfaceSample>& samples_;
  const FitEffort effort_;
  const std::vector<Vec3> start_;
  std::vector<Vec3> positions_;
  std::vector<char> free_;
  std::vector<double> squared_;  ///< distances of the samples
};

}  // namespace

std::vector<Vec3> fit_closest(const SubdivisionLevel& finest, const FoldGuard& guard,
                              std::vector<SurfaceSample> samples, const FitEffort& effort,
                              const std::vector<Vec3>& start) {
  // In units of the extent, a power of two, so that no square overflows.
  double extent = 0.0;
  for (const Vec3& p : start) extent = std::max(extent, (p - start[0]).cwiseAbs().maxCoeff());
  if (!(extent > 0.0) || !std::isfinite(extent)) return start;
  const double unit = std::exp2(std::ceil(std::log2(extent)));
  std::vector<Vec3> scaled(start.size());
  for (std::size_t v = 0; v < start.size(); ++v) scaled[v] = (start[v] - start[0]) / unit;
  for (SurfaceSample& sample : samples) sample.point = (sample.point - start[0]) / unit;
  const std::vector<Vec3> fitted = ClosestFit(finest, guard, samples, effort, scaled).run();
  std::vector<Vec3> positions = start;
  for (std::size_t v = 0; v < start.size(); ++v)
    if (fitted[v] != scaled[v]) positions[v] += unit * (fitted[v] - scaled[v]);
  return positions;
}

}  // namespace gsp
