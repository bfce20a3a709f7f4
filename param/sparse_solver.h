#pragma once

#include <complex>
#include <memory>

#include <Eigen/SparseCore>

#include "param/lattice.h"

namespace gsp {

using ComplexMatrix = Eigen::SparseMatrix<Complex>;
using ComplexVector = Eigen::VectorXcd;

/// Solves the square system A x = b directly (UMFPACK, or Eigen's SparseLU where GSP_SUITESPARSE is off).
/// Throws Error(SolverFailed) where A is singular to working precision or the residual is larger than 1e-8 of b.
ComplexVector solve_sparse(const ComplexMatrix& a, const ComplexVector& b);

/// The same for a real system with two right-hand sides; false where it could not be solved.
bool solve_sparse(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixX2d& b, Eigen::MatrixX2d& x);

}  // namespace gsp
