#include "param/energy/lower_peaks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Dense>

#include "mesh/parallel.h"

namespace gsp {

namespace {

constexpr double kPeak = 10.0;  // energy by area, that of an isometry being 2
constexpr int kSweeps = 100;
constexpr double kLittle = 0.01;  // share of the energy around the peaks that a sweep has to gain
constexpr double kShortestStep = 1.0 / 64.0;

class Peaks {
 public:
  Peaks(const DistortionEnergy& energy, std::vector<double>& x)
      : energy_(energy), x_(x), first_(energy.variable_count() + 1, 0), density_(energy.face_count()) {
    for_each_corner([&](int variable, int, int) { ++first_[variable + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    around_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for_each_corner([&](int variable, int face, int corner) { around_[next[variable]++] = {face, corner}; });
  }

  /// One step of every vertex of a peak. Returns the share of the energy around them that it gained, 0 without peaks.
  double sweep() {
    parallel_for(density_.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) density_[f] = energy_.density(static_cast<int>(f), x_.data());
    });
    std::vector<char> at_peak(energy_.variable_count(), 0);
    for_each_corner([&](int variable, int face, int) { at_peak[variable] |= density_[face] > kPeak; });
    double before = 0.0, gained = 0.0;
    for (int v = 0; v < energy_.variable_count(); ++v)
      if (at_peak[v]) {
        const auto [energy, gain] = step(v);
        before += energy;
        gained += gain;
      }
    return before > 0.0 ? gained / before : 0.0;
  }

 private:
  struct Corner {
    int face, corner;
  };
  struct Step {
    double energy, gain;
  };

  template <class Visit>
  void for_each_corner(Visit&& visit) const {
    for (int f = 0; f < energy_.face_count(); ++f) {
      const auto variables = energy_.variables(f);
      for (int k = 0; k < 3; ++k)
        if (variables[k] >= 0) visit(variables[k], f, k);
    }
  }

  double energy_around(int v) const {
    double sum = 0.0;
    for (int i = first_[v]; i < first_[v + 1]; ++i)
      sum += energy_.weight(around_[i].face) * energy_.density(around_[i].face, x_.data());
    return sum;
  }

  Step step(int v) {
    double before = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
    for (int i = first_[v]; i < first_[v + 1]; ++i) {
      const auto at = energy_.by_corner(around_[i].face, around_[i].corner, x_.data());
      before += at.energy;
      gradient += at.gradient;
      hessian += at.convex_hessian;
    }
    const Eigen::Vector2d direction = -hessian.inverse() * gradient;
    const Eigen::Vector2d start(x_[2 * v], x_[2 * v + 1]);
    const auto go = [&](double t) {
      x_[2 * v] = start[0] + t * direction[0];
      x_[2 * v + 1] = start[1] + t * direction[1];
    };
    if (direction.allFinite())
      for (double t = 1.0; t >= kShortestStep; t *= 0.5) {
        go(t);
        const double after = energy_around(v);
        if (after < before) return {before, before - after};
      }
    x_[2 * v] = start[0];
    x_[2 * v + 1] = start[1];
    return {before, 0.0};
  }

  const DistortionEnergy& energy_;
  std::vector<double>& x_;
  std::vector<int> first_;       ///< per variable and one more, into around_
  std::vector<Corner> around_;   ///< the corners of faces at each variable
  std::vector<double> density_;  ///< per face
};

}  // namespace

void lower_peaks(const DistortionEnergy& energy, std::vector<double>& x) {
  assert(static_cast<int>(x.size()) == 2 * energy.variable_count() && energy.upright(x));
  Peaks peaks(energy, x);
  for (int i = 0; i < kSweeps; ++i)
    if (peaks.sweep() < kLittle) return;
}

}  // namespace gsp
