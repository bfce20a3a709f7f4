#include "remesh/scalar/scalar_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "remesh/fold_guard.h"
#include "remesh/scalar/scalar_synthesis.h"

namespace gsp {

namespace {

/// Of boundary vertices, in units of the samples' weight over a face: as firm as samples hold a vertex.
constexpr double kBoundaryTether = 1.0;

std::vector<Vec3> face_areas(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<Vec3> areas;
  for (const Triangle& t : level.faces) areas.push_back(doubled_area(t, positions));
  return areas;
}

class Fit {
 public:
  Fit(const std::vector<SubdivisionLevel>& levels, const std::vector<char>& exceptional, bool lifted,
      std::vector<SurfaceSample>& samples, const FitEffort& effort, const std::vector<Vec3>& start)
      : levels_(levels),
        synthesis_(levels, exceptional, lifted),
        effort_(effort),
        form_(synthesis_.of(start)),
        positions_(synthesis_.positions(form_)),
        areas_(face_areas(levels.back(), start)),
        guard_(levels.back(), areas_),
        energy_(levels.back(), samples, {effort.stiffness, 1e-4, kBoundaryTether}, start),
        scale_(start.size()) {
    // The squared norm of what a coefficient adds to the surface goes with the area under it.
    std::size_t v = 0;
    for (std::size_t l = 0; l < levels.size(); ++l)
      for (; v < static_cast<std::size_t>(levels[l].vertex_count); ++v)
        scale_[v] = std::ldexp(1.0, -2 * static_cast<int>(levels.size() - 1 - l));
  }

  std::vector<Vec3> run() {
    constexpr double kRounding = 1e-30;
    double energy = energy_.at(positions_);
    for (int round = 0; round < effort_.most_rounds && energy > kRounding * levels_.back().face_count(); ++round) {
      const double before = energy;
      if (!step(energy) || energy > (1.0 - effort_.enough) * before) break;
    }
    energy_.at(positions_);
    return positions_;
  }

  double squared() const { return energy_.of_samples(); }

 private:
  ScalarForm preconditioned(ScalarForm form) const {
    for (std::size_t v = 0; v < form.base.size(); ++v) form.base[v] *= scale_[v];
    for (std::size_t n = 0; n < form.details.size(); ++n) form.details[n] *= scale_[form.base.size() + n];
    return form;
  }

  /// The change of least energy, to 1e-2 in its own norm, by conjugate gradients.
  ScalarForm change(const VertexSystem& system) const {
    constexpr double kTolerance = 1e-2;
    constexpr int kMostIterations = 100;
    ScalarForm residual = synthesis_.pulled(system.right());
    ScalarForm scaled = preconditioned(residual), direction = scaled;
    ScalarForm change = residual.plus(residual, -1.0);
    double left = residual.dot(scaled);
    const double enough = kTolerance * kTolerance * left;
    for (int i = 0; i < kMostIterations && left > enough; ++i) {
      const ScalarForm product = synthesis_.pulled(system.times(synthesis_.moves(direction)));
      const double length = left / direction.dot(product);
      change = change.plus(direction, length);
      residual = residual.plus(product, -length);
      scaled = preconditioned(residual);
      const double now = residual.dot(scaled);
      direction = scaled.plus(direction, now / left);
      left = now;
    }
    return change;
  }

  struct Trial {
    ScalarForm form;
    std::vector<Vec3> positions;
  };

  /// A part of the change: of coefficients where faces would fold half of that, a quarter, then nothing, and nothing of
  /// those around them. Nothing where that is not enough.
  std::optional<Trial> guarded(const ScalarForm& change, double part) {
    constexpr int kHalvings = 2;
    const int most_passes = kHalvings + 2 * static_cast<int>(levels_.size()) + 2;
    ScalarForm taken = change;
    std::vector<char> frozen(positions_.size(), 0);
    for (int pass = 0; pass < most_passes; ++pass) {
      Trial trial{form_.plus(taken, part), {}};
      trial.positions = synthesis_.positions(trial.form);
      std::vector<char> held(trial.positions.size(), 0);
      if (!guard_.hold(positions_, trial.positions, held)) return trial;
      if (pass < kHalvings) {
        scale_marked(held, 0.5, taken);
        continue;
      }
      freeze(held, pass - kHalvings, frozen);
      scale_marked(frozen, 0.0, taken);
    }
    return std::nullopt;
  }

  static void scale_marked(const std::vector<char>& marked, double factor, ScalarForm& form) {
    for (std::size_t v = 0; v < marked.size(); ++v)
      if (marked[v]) (v < form.base.size() ? form.base[v] : form.details[v - form.base.size()]) *= factor;
  }

  /// Those that are held, and around those that were frozen already, which was not enough, the corners of the faces of
  /// `rings` levels, the finest first.
  void freeze(std::vector<char>& held, int rings, std::vector<char>& frozen) const {
    const int finest = static_cast<int>(levels_.size()) - 1;
    for (int l = finest; l > std::max(finest - rings, -1); --l)
      for (const Triangle& t : levels_[l].faces)
        if (frozen[t[0]] || frozen[t[1]] || frozen[t[2]])
          for (int v : t) held[v] = 1;
    for (std::size_t v = 0; v < held.size(); ++v) frozen[v] |= held[v];
  }

  /// False where no part of the step lowers the energy.
  bool step(double& energy) {
    constexpr double kShortest = 0.1;
    const ScalarForm whole = change(energy_.linearized(positions_));
    for (double part = 1.0; part > kShortest; part /= 2.0) {
      std::optional<Trial> trial = guarded(whole, part);
      if (!trial) continue;
      const double there = energy_.at(trial->positions);
      if (!(there < energy)) continue;
      energy = there;
      form_ = std::move(trial->form);
      positions_ = std::move(trial->positions);
      return true;
    }
    return false;
  }

  const std::vector<SubdivisionLevel>& levels_;
  ScalarSynthesis synthesis_;
  const FitEffort effort_;
  ScalarForm form_;
  std::vector<Vec3> positions_;
  const std::vector<Vec3> areas_;
  const FoldGuard guard_;
  ClosestEnergy energy_;
  std::vector<double> scale_;  ///< of each coefficient, the inverse of its weight in the energy
};

}  // namespace

ScalarFit fit_scalars(const std::vector<SubdivisionLevel>& levels, const std::vector<char>& exceptional, bool lifted,
                      std::vector<SurfaceSample> samples, const FitEffort& effort, const std::vector<Vec3>& start) {
  // In units of the extent, a power of two, so that no square overflows.
  double extent = 0.0;
  for (const Vec3& p : start) extent = std::max(extent, (p - start[0]).cwiseAbs().maxCoeff());
  if (!(extent > 0.0) || !std::isfinite(extent)) return {start, 0.0};
  const double unit = std::exp2(std::ceil(std::log2(extent)));
  std::vector<Vec3> scaled(start.size());
  for (std::size_t v = 0; v < start.size(); ++v) scaled[v] = (start[v] - start[0]) / unit;
  double weight = 0.0;
  for (SurfaceSample& sample : samples) {
    sample.point = (sample.point - start[0]) / unit;
    weight += sample.weight;
  }
  Fit fit(levels, exceptional, lifted, samples, effort, scaled);
  ScalarFit result{fit.run(), 0.0};
  for (Vec3& p : result.positions) p = start[0] + unit * p;
  if (weight > 0.0) result.rms = unit * std::sqrt(fit.squared() / weight);
  return result;
}

}  // namespace gsp
