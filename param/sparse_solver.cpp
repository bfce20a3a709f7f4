#include "param/sparse_solver.h"

#include <mutex>

#ifdef GSP_SUITESPARSE
#include <dlfcn.h>

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>
#else
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#endif

#include "mesh/error.h"

namespace gsp {

namespace {

#ifdef GSP_SUITESPARSE
template <class Matrix>
using Solver = Eigen::UmfPackLU<Matrix>;
using Cholesky = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

/// A threaded BLAS sums in an order that depends on the number of threads; results must not. CHOLMOD's own threads make
/// loops that are too short for them, and take a fifth of its time.
void use_one_solver_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    const auto call = [](const char* name, int value) {
      if (void* function = dlsym(RTLD_DEFAULT, name)) reinterpret_cast<void (*)(int)>(function)(value);
    };
    call("openblas_set_num_threads", 1);
    call("omp_set_max_active_levels", 0);
  });
}
#else
template <class Matrix>
using Solver = Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>;
using Cholesky = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

void use_one_solver_thread() {}
#endif

}  // namespace

ComplexVector solve_sparse(const ComplexMatrix& a, const ComplexVector& b) {
  if (b.size() == 0) return b;
  use_one_solver_thread();
  Solver<ComplexMatrix> solver;
  solver.compute(a);
  if (solver.info() != Eigen::Success)
    throw Error(Cause::SolverFailed, "the sparse system of " + std::to_string(b.size()) + " unknowns was not factorized");
  ComplexVector x = solver.solve(b);
  const double residual = (a * x - b).norm();
  if (!(residual <= 1e-8 * (b.norm() + 1e-300)))
    throw Error(Cause::SolverFailed, "the sparse system was solved with a residual of " + std::to_string(residual));
  return x;
}

bool solve_sparse(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixX2d& b, Eigen::MatrixX2d& x) {
  use_one_solver_thread();
  Solver<Eigen::SparseMatrix<double>> solver;
  solver.compute(a);
  if (solver.info() != Eigen::Success) return false;
  x.resize(b.rows(), 2);
  for (int column = 0; column < 2; ++column) {
    const Eigen::VectorXd right = b.col(column);
    x.col(column) = solver.solve(right);
  }
  return x.allFinite() && (a * x - b).norm() <= 1e-8 * (b.norm() + 1e-300);
}

struct CholeskySolver::Factor {
  Cholesky llt;
  bool analysed = false;
};

CholeskySolver::CholeskySolver() : factor_(std::make_unique<Factor>()) {
#ifdef GSP_SUITESPARSE
  factor_->llt.cholmod().print = 0;  // it would write to standard output
#endif
}
CholeskySolver::~CholeskySolver() = default;

bool CholeskySolver::factorize(const Eigen::SparseMatrix<double>& lower) {
  use_one_solver_thread();
  if (!factor_->analysed) factor_->llt.analyzePattern(lower);
  factor_->analysed = true;
  factor_->llt.factorize(lower);
  return factor_->llt.info() == Eigen::Success;
}

Eigen::VectorXd CholeskySolver::solve(const Eigen::VectorXd& b) const { return factor_->llt.solve(b); }

}  // namespace gsp
