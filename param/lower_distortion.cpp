#include "param/lower_distortion.h"

#include <cmath>
#include <numeric>

#include <Eigen/SparseCholesky>
#include <lbfgs.h>

#include "mesh/error.h"
#include "param/distortion_energy.h"
#include "param/folds.h"
#include "param/global_system.h"
#include "param/sparse_solver.h"

namespace gsp {

namespace {

constexpr double kAreaWeight = 1.0;

/// The energy in the variables y with x = x0 + P⁻¹ L⁻* y, in which the Dirichlet form P⁻¹ L L* P is the identity.
class Preconditioned {
 public:
  Preconditioned(const DistortionEnergy& energy, std::vector<double> start, int steps, Progress& progress)
      : energy_(energy), start_(std::move(start)), gradient_(start_.size()), steps_(steps), progress_(progress) {
    factor_.compute(energy.dirichlet_form());
    if (factor_.info() != Eigen::Success) throw Error(Cause::SolverFailed, "the Dirichlet form was not factorized");
  }

  std::vector<double> at(const double* y) const {
    ComplexVector step = Eigen::Map<const ComplexVector>(reinterpret_cast<const Complex*>(y), start_.size() / 2);
    factor_.matrixU().solveInPlace(step);
    step = factor_.permutationPinv() * step;
    std::vector<double> x = start_;
    for (Eigen::Index i = 0; i < step.size(); ++i) {
      x[2 * i] += step[i].real();
      x[2 * i + 1] += step[i].imag();
    }
    return x;
  }

  double evaluate(const double* y, double* gradient) {
    const double energy = energy_.evaluate(at(y).data(), gradient_.data(), 0.0);
    const Eigen::Index n = static_cast<Eigen::Index>(start_.size() / 2);
    ComplexVector g = Eigen::Map<const ComplexVector>(reinterpret_cast<const Complex*>(gradient_.data()), n);
    g = factor_.permutationP() * g;
    factor_.matrixL().solveInPlace(g);
    Eigen::Map<ComplexVector>(reinterpret_cast<Complex*>(gradient), n) = g;
    return energy;
  }

  void step_made(int step) { progress_.report("lower distortion", std::min(1.0, double(step) / steps_)); }

 private:
  const DistortionEnergy& energy_;
  const std::vector<double> start_;
  std::vector<double> gradient_;
  int steps_;
  Progress& progress_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<Complex>> factor_;
};

}  // namespace

bool lower_distortion(Atlas& atlas, int steps, Progress& progress) {
  seat_boundary(atlas);
  const std::vector<char> interior = interior_vertices(atlas);
  std::vector<int> vertices, faces(atlas.surface->mesh.faces.size());
  for (std::size_t v = 0; v < interior.size(); ++v)
    if (interior[v]) vertices.push_back(static_cast<int>(v));
  if (vertices.empty()) return false;
  std::iota(faces.begin(), faces.end(), 0);
  const DistortionEnergy energy(atlas, vertices, faces, kAreaWeight);
  Preconditioned problem(energy, energy.positions(atlas), steps, progress);

  lbfgs_parameter_t parameters;
  lbfgs_parameter_init(&parameters);
  parameters.max_iterations = steps;
  parameters.epsilon = 1e-6;
  parameters.past = 5;
  parameters.delta = 1e-5;
  parameters.linesearch = LBFGS_LINESEARCH_BACKTRACKING_ARMIJO;
  parameters.max_linesearch = 60;
  std::vector<double> y(2 * vertices.size(), 0.0);
  double least = 0.0;
  lbfgs(
      static_cast<int>(y.size()), y.data(), &least,
      [](void* self, const double* at, double* gradient, const int, const double) {
        return static_cast<Preconditioned*>(self)->evaluate(at, gradient);
      },
      [](void* self, const double*, const double*, const double, const double, const double, const double, int, int step,
         int) {
        static_cast<Preconditioned*>(self)->step_made(step);
        return 0;
      },
      &problem, &parameters);
  const std::vector<Complex> before = atlas.position;
  const std::vector<double> x = problem.at(y.data());
  energy.write_back(x, atlas);
  if (!energy.upright(x) || !find_folds(atlas).none()) {
    atlas.position = before;
    return false;
  }
  atlas.reassign_all();
  return true;
}

}  // namespace gsp
