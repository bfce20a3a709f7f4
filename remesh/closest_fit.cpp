#include "remesh/closest_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gsp {

namespace {

class ClosestFit {
 public:
  ClosestFit(const SubdivisionLevel& finest, const FoldGuard& guard, std::vector<SurfaceSample>& samples,
             const FitEffort& effort, std::vector<Vec3> start)
      : finest_(finest),
        guard_(guard),
        effort_(effort),
        start_(std::move(start)),
        positions_(start_),
        energy_(finest, samples, {effort.stiffness}, start_) {}

  const std::vector<Vec3>& run() {
    // Relative to coordinates up to 1: mean squares below are rounding.
    constexpr double kRounding = 1e-30;
    double energy = energy_.at(positions_);
    for (int round = 0; round < effort_.most_rounds && energy > kRounding * finest_.face_count(); ++round) {
      const double before = energy;
      if (!step(energy) || energy > (1.0 - effort_.enough) * before) break;
    }
    return positions_;
  }

 private:
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
    const std::vector<Vec3> moves = energy_.linearized(positions_).solve();
    for (double part = 1.0; part > kShortest; part /= 2.0) {
      const std::vector<Vec3> moved = guarded(moves, part);
      const double energy_there = energy_.at(moved);
      if (!(energy_there < energy)) continue;
      energy = energy_there;
      positions_ = moved;
      return true;
    }
    return false;
  }

  const SubdivisionLevel& finest_;
  const FoldGuard& guard_;
  const FitEffort effort_;
  const std::vector<Vec3> start_;
  std::vector<Vec3> positions_;
  ClosestEnergy energy_;
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
