#include "param/energy/newton_descent.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "mesh/parallel.h"
#include "param/energy/lower_peaks.h"

namespace gsp {

namespace {

constexpr double kShare = 0.9;      // of the way to the first fold
constexpr double kShortStep = 0.5;  // that a fold has held up
constexpr double kArmijo = 1e-4;
constexpr double kLeastStep = 1e-6;
constexpr double kSmallestShift = 1e-12, kLargestShift = 0.1;  // of the Hessian's diagonal

}  // namespace

NewtonDescent::NewtonDescent(const DistortionEnergy& energy, std::vector<double>& x)
    : energy_(energy),
      x_(x),
      face_hessians_(energy.face_count()),
      gradient_(x.size()),
      trial_(x.size()),
      trial_gradient_(x.size()) {
  assert(static_cast<int>(x.size()) == 2 * energy.variable_count() && energy.upright(x));
  find_pattern();
  value_ = energy_.evaluate(x_.data(), gradient_.data(), 0.0);
}

/// visit(face, row in the face, column in the face, row, column) for the entries of the lower triangle.
template <class Visit>
void NewtonDescent::for_each_entry(Visit&& visit) const {
  for (int f = 0; f < energy_.face_count(); ++f) {
    const auto variables = energy_.variables(f);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        if (variables[i / 2] < 0 || variables[j / 2] < 0) continue;
        const int row = 2 * variables[i / 2] + i % 2, column = 2 * variables[j / 2] + j % 2;
        if (row >= column) visit(f, i, j, row, column);
      }
  }
}

void NewtonDescent::find_pattern() {
  const int count = energy_.variable_count();
  // Per variable, the later ones that share a face with it.
  std::vector<int> first(count + 1, 0), later;
  const auto for_each_pair = [&](auto&& visit) {
    for (int f = 0; f < energy_.face_count(); ++f) {
      const auto v = energy_.variables(f);
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(v[k], v[(k + 1) % 3]);
        if (low >= 0 && low < high) visit(low, high);
      }
    }
  };
  for_each_pair([&](int low, int) { ++first[low + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  later.resize(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for_each_pair([&](int low, int high) { later[next[low]++] = high; });

  std::vector<int> columns{0}, rows;
  for (int v = 0; v < count; ++v) {
    const auto begin = later.begin() + first[v];
    std::sort(begin, later.begin() + first[v + 1]);
    const auto end = std::unique(begin, later.begin() + first[v + 1]);
    for (int column = 2 * v; column <= 2 * v + 1; ++column) {
      for (int row = column; row <= 2 * v + 1; ++row) rows.push_back(row);
      for (auto w = begin; w != end; ++w) {
        rows.push_back(2 * *w);
        rows.push_back(2 * *w + 1);
      }
      columns.push_back(static_cast<int>(rows.size()));
    }
  }
  const std::vector<double> zeros(rows.size(), 0.0);
  hessian_ = Eigen::Map<const Eigen::SparseMatrix<double>>(2 * count, 2 * count, rows.size(), columns.data(),
                                                           rows.data(), zeros.data());
  for_each_entry([&](int, int, int, int row, int column) {
    const auto begin = rows.begin() + columns[column], end = rows.begin() + columns[column + 1];
    place_.push_back(static_cast<int>(std::lower_bound(begin, end, row) - rows.begin()));
  });
}

void NewtonDescent::fill_hessian() {
  parallel_for(face_hessians_.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      face_hessians_[f] = energy_.convex_hessian(static_cast<int>(f), x_.data());
  });
  double* values = hessian_.valuePtr();
  std::fill(values, values + hessian_.nonZeros(), 0.0);
  std::size_t entry = 0;
  for_each_entry([&](int f, int i, int j, int, int) { values[place_[entry++]] += face_hessians_[f](i, j); });
}

/// Where rounding has lost that the Hessian is definite, a small share is added to its diagonal.
bool NewtonDescent::factorize() {
  fill_hessian();
  for (double more = 0.0; more < kLargestShift; more = std::max(kSmallestShift, 100.0 * more)) {
    if (more > 0.0) hessian_.diagonal() *= 1.0 + more;
    if (solver_.factorize(hessian_)) return true;
  }
  return false;
}

double NewtonDescent::step() {
  if (!factorize()) return 0.0;
  const Eigen::Map<Eigen::VectorXd> gradient(gradient_.data(), gradient_.size());
  const Eigen::VectorXd direction = solver_.solve(-gradient);
  const double slope = gradient.dot(direction);
  if (!(slope < 0.0)) return 0.0;
  const double longest = energy_.longest_step(x_.data(), direction.data());
  for (double t = longest < 1.0 ? kShare * longest : 1.0; t > kLeastStep; t *= 0.5) {
    for (std::size_t i = 0; i < x_.size(); ++i) trial_[i] = x_[i] + t * direction[i];
    const double value = energy_.evaluate(trial_.data(), trial_gradient_.data(), 0.0);
    if (!(value <= value_ + kArmijo * t * slope) || !energy_.upright(trial_)) continue;
    const double before = value_;
    value_ = value;
    x_.swap(trial_);
    gradient_.swap(trial_gradient_);
    if (t < kShortStep) {
      lower_peaks(energy_, x_);
      value_ = energy_.evaluate(x_.data(), gradient_.data(), 0.0);
    }
    return (before - value_) / before;
  }
  return 0.0;
}

}  // namespace gsp
