#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "param/energy/distortion_energy.h"
#include "param/linear/sparse_solver.h"

namespace gsp {

/// Lowers a distortion energy by Newton steps with its convex Hessian, over maps free of folds. One sparse Cholesky
/// factorization a step; the pattern is analysed once.
class NewtonDescent {
 public:
  /// `x`: positions of a map free of folds, and of one after every step.
  NewtonDescent(const DistortionEnergy& energy, std::vector<double>& x);

  /// One step. Returns the share of the energy it gained, 0 where it found nothing.
  double step();
  /// The energy at x.
  double value() const { return value_; }

 private:
  template <class Visit>
  void for_each_entry(Visit&& visit) const;
  void find_pattern();
  void fill_hessian();
  bool factorize();

  const DistortionEnergy& energy_;
  std::vector<double>& x_;
  Eigen::SparseMatrix<double> hessian_;  ///< its lower triangle
  std::vector<int> place_;               ///< per entry of a face's, where its value is
  std::vector<Eigen::Matrix<double, 6, 6>> face_hessians_;
  CholeskySolver solver_;
  std::vector<double> gradient_, trial_, trial_gradient_;
  double value_;
};

}  // namespace gsp
