#pragma once

#include <complex>
#include <memory>

#include <Eigen/SparseCore>

#include "param/map/lattice.h"

namespace gsp {

// Solvers run on the calling thread alone, so that results do not depend on a threaded BLAS. While one runs, OpenBLAS
// has one thread for the whole process; afterwards its number of threads is what it was.

using ComplexMatrix = Eigen::SparseMatrix<Complex>;
using ComplexVector = Eigen::VectorXcd;

/// Solves the square system A x = b directly (UMFPACK, or Eigen's SparseLU where GSP_SUITESPARSE is off).
/// Throws Error(SolverFailed) where A is singular to working precision or the residual is larger than 1e-8 of b.
ComplexVector solve_sparse(const ComplexMatrix& a, const ComplexVector& b);

/// The same for a Hermitian positive definite system of which the lower triangle is given (CHOLMOD, or Eigen's LLT).
ComplexVector solve_hermitian(const ComplexMatrix& lower, const ComplexVector& b);

/// The same for a real system with two right-hand sides; false where it could not be solved.
bool solve_sparse(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixX2d& b, Eigen::MatrixX2d& x);

/// Solves symmetric positive definite systems of one pattern, one after the other: the symbolic analysis is made once.
/// CHOLMOD, or Eigen's LLT where GSP_SUITESPARSE is off.
class CholeskySolver {
 public:
  CholeskySolver();
  ~CholeskySolver();
  /// `lower`: its lower triangle. False where it is not positive definite to working precision.
  bool factorize(const Eigen::SparseMatrix<double>& lower);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace gsp
