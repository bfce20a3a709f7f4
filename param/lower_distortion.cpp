#include "param/lower_distortion.h"

#include <cmath>
#include <numeric>

#include "mesh/parallel.h"
#include "param/distortion_energy.h"
#include "param/folds.h"
#include "param/global_system.h"
#include "param/lower_peaks.h"
#include "param/sparse_solver.h"

namespace gsp {

namespace {

constexpr double kAreaWeight = 1.0;
constexpr int kMostSteps = 100;
constexpr double kShare = 0.9;          // of the way to the first fold
constexpr double kShortStep = 0.5;      // that a fold has held up
constexpr double kArmijo = 1e-4;
constexpr double kShortestStep = 1e-6;
constexpr double kSmallestShift = 1e-12, kLargestShift = 0.1;  // of the Hessian's diagonal

/// The convex Hessian of a whole energy: the pattern is found once, the values are filled in for each x.
class Hessian {
 public:
  explicit Hessian(const DistortionEnergy& energy) : energy_(energy) {
    std::vector<Eigen::Triplet<double>> entries;
    for_each_entry([&](int, int, int, int row, int column) { entries.emplace_back(row, column, 0.0); });
    const int n = 2 * energy.variable_count();
    matrix_.resize(n, n);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    place_.reserve(entries.size());
    for_each_entry([&](int, int, int, int row, int column) {
      const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
      const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
      place_.push_back(static_cast<int>(std::lower_bound(first, last, row) - matrix_.innerIndexPtr()));
    });
    faces_.resize(energy.face_count());
  }

  /// The lower triangle at x.
  Eigen::SparseMatrix<double>& at(const double* x) {
    parallel_for(faces_.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) faces_[f] = energy_.convex_hessian(static_cast<int>(f), x);
    });
    double* values = matrix_.valuePtr();
    std::fill(values, values + matrix_.nonZeros(), 0.0);
    std::size_t entry = 0;
    for_each_entry([&](int f, int i, int j, int, int) { values[place_[entry++]] += faces_[f](i, j); });
    return matrix_;
  }

 private:
  /// visit(face, row in the face, column in the face, row, column) for the entries of the lower triangle.
  template <class Visit>
  void for_each_entry(Visit&& visit) const {
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

  const DistortionEnergy& energy_;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<int> place_;  ///< per entry, where its value is
  std::vector<Eigen::Matrix<double, 6, 6>> faces_;
};

class Descent {
 public:
  Descent(const DistortionEnergy& energy, std::vector<double>& x) : energy_(energy), x_(x), hessian_(energy), gradient_(x.size()) {
    value_ = energy_.evaluate(x_.data(), gradient_.data(), 0.0);
  }

  /// One Newton step. Returns the share of the energy it gained, 0 where it found nothing.
  double step() {
    if (!factorize()) return 0.0;
    const Eigen::Map<Eigen::VectorXd> gradient(gradient_.data(), gradient_.size());
    const Eigen::VectorXd direction = solver_.solve(-gradient);
    const double slope = gradient.dot(direction);
    if (!(slope < 0.0)) return 0.0;
    const double longest = energy_.longest_step(x_.data(), direction.data());
    std::vector<double> trial(x_.size()), trial_gradient(x_.size());
    for (double t = longest < 1.0 ? kShare * longest : 1.0; t > kShortestStep; t *= 0.5) {
      for (std::size_t i = 0; i < x_.size(); ++i) trial[i] = x_[i] + t * direction[i];
      const double value = energy_.evaluate(trial.data(), trial_gradient.data(), 0.0);
      if (!(value <= value_ + kArmijo * t * slope) || !energy_.upright(trial)) continue;
      const double before = value_;
      value_ = value;
      x_.swap(trial);
      gradient_.swap(trial_gradient);
      if (t < kShortStep) {
        lower_peaks(energy_, x_);
        value_ = energy_.evaluate(x_.data(), gradient_.data(), 0.0);
      }
      return (before - value_) / before;
    }
    return 0.0;
  }

 private:
  /// Where rounding has lost that the Hessian is definite, a small share is added to its diagonal.
  bool factorize() {
    Eigen::SparseMatrix<double>& matrix = hessian_.at(x_.data());
    for (double more = 0.0; more < kLargestShift; more = std::max(kSmallestShift, 100.0 * more)) {
      if (more > 0.0) matrix.diagonal() *= 1.0 + more;
      if (solver_.factorize(matrix)) return true;
    }
    return false;
  }

  const DistortionEnergy& energy_;
  std::vector<double>& x_;
  Hessian hessian_;
  CholeskySolver solver_;
  std::vector<double> gradient_;
  double value_;
};

}  // namespace

bool lower_distortion(Atlas& atlas, double least_gain, Progress& progress) {
  seat_boundary(atlas);
  std::vector<int> vertices, faces(atlas.surface->mesh.faces.size());
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v)
    if (atlas.is_free(v)) vertices.push_back(v);
  if (vertices.empty()) return false;
  std::iota(faces.begin(), faces.end(), 0);
  const DistortionEnergy energy(atlas, vertices, faces, kAreaWeight);
  std::vector<double> x = energy.positions(atlas);
  const std::vector<Complex> before = atlas.position;
  lower_peaks(energy, x);
  Descent descent(energy, x);
  for (int i = 0; i < kMostSteps; ++i) {
    progress.report("lower distortion", double(i) / kMostSteps);
    if (descent.step() < least_gain) break;
  }
  energy.write_back(x, atlas);
  if (!find_folds(atlas).none()) {
    atlas.position = before;
    return false;
  }
  atlas.reassign_all();
  return true;
}

}  // namespace gsp
