#include "param/linear/sparse_solver.h"

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
template <class Matrix>
using Cholesky = Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower>;

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
template <class Matrix>
using Cholesky = Eigen::SimplicialLLT<Matrix, Eigen::Lower>;

void use_one_solver_thread() {}
#endif

/// CHOLMOD would write to standard output what its state says too.
template <class Matrix>
void keep_quiet(Cholesky<Matrix>& solver) {
#ifdef GSP_SUITESPARSE
  solver.cholmod().print = 0;
#else
  (void)solver;
#endif
}

ComplexVector require_solved(ComplexVector x, const ComplexVector& residual, const ComplexVector& b) {
  if (!(residual.norm() <= 1e-8 * (b.norm() + 1e-300)))
    throw Error(Cause::SolverFailed,
                "the sparse system was solved with a residual of " + std::to_string(residual.norm()));
  return x;
}

template <class AnySolver>
void require_factorized(const AnySolver& solver, const ComplexVector& b) {
  if (solver.info() != Eigen::Success)
    throw Error(Cause::SolverFailed,
                "the sparse system of " + std::to_string(b.size()) + " unknowns was not factorized");
}

}  // namespace

ComplexVector solve_sparse(const ComplexMatrix& a, const ComplexVector& b) {
  if (b.size() == 0) return b;
  use_one_solver_thread();
  Solver<ComplexMatrix> solver;
  solver.compute(a);
  require_factorized(solver, b);
  const ComplexVector x = solver.solve(b);
  return require_solved(x, a * x - b, b);
}

ComplexVector solve_hermitian(const ComplexMatrix& lower, const ComplexVector& b) {
  if (b.size() == 0) return b;
  use_one_solver_thread();
  Cholesky<ComplexMatrix> solver;
  keep_quiet(solver);
  solver.compute(lower);
  require_factorized(solver, b);
  const ComplexVector x = solver.solve(b);
  return require_solved(x, lower.selfadjointView<Eigen::Lower>() * x - b, b);
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
  Cholesky<Eigen::SparseMatrix<double>> llt;
  bool analysed = false;
};

CholeskySolver::CholeskySolver() : factor_(std::make_unique<Factor>()) { keep_quiet(factor_->llt); }
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
