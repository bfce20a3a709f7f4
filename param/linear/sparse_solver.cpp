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
#include "param/linear/address_space.h"

namespace gsp {

namespace {

#ifdef GSP_SUITESPARSE
template <class Matrix>
using Solver = Eigen::UmfPackLU<Matrix>;
template <class Matrix>
using Cholesky = Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower>;

/// A setting of another library, by the names of its two functions; none where that library is not loaded.
class Setting {
 public:
  Setting(const char* get, const char* set)
      : get_(reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, get))),
        set_(reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, set))) {}
  /// Sets it and returns what it was.
  int exchange(int value) const {
    if (!get_ || !set_) return value;
    const int before = get_();
    if (before != value) set_(value);
    return before;
  }

 private:
  int (*get_)();
  void (*set_)(int);
};

/// OpenBLAS 0.3.21 maps 128 MiB for each call that runs beside others.
constexpr std::size_t kBlasMemory = std::size_t{144} << 20;

/// Those alive on this thread.
thread_local int alone_here = 0;

/// While one lives, solvers use this thread alone. A threaded BLAS sums in an order that depends on the number of
/// threads; results must not. CHOLMOD's own threads make loops that are too short for them, and take a fifth of its
/// time. OpenBLAS has one number of threads for the process: the first that begins sets it and the last that ends puts
/// back what was there. OpenMP's setting is the calling thread's own. It is made after the solver: the program loads
/// the libraries with the first one (cli/late_suitesparse.cpp). Throws std::bad_alloc where the BLAS would have no
/// room.
class OneSolverThread {
 public:
  OneSolverThread() {
    {
      const std::lock_guard<std::mutex> lock(mutex());
      if (alive_ == most_alive_) {  // those before have their memory, or are about to take it
        require_address_space((alive_ + 1) * kBlasMemory);
        ++most_alive_;
      }
      if (alive_++ == 0) blas_before_ = blas().exchange(1);
    }
    levels_before_ = levels().exchange(0);
    ++alone_here;
  }
  ~OneSolverThread() {
    --alone_here;
    levels().exchange(levels_before_);
    const std::lock_guard<std::mutex> lock(mutex());
    if (--alive_ == 0) blas().exchange(blas_before_);
  }
  OneSolverThread(const OneSolverThread&) = delete;
  OneSolverThread& operator=(const OneSolverThread&) = delete;

 private:
  static const Setting& blas() {
    static const Setting setting("openblas_get_num_threads", "openblas_set_num_threads");
    return setting;
  }
  static const Setting& levels() {
    static const Setting setting("omp_get_max_active_levels", "omp_set_max_active_levels");
    return setting;
  }
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static inline int alive_ = 0, most_alive_ = 0, blas_before_ = 1;
  int levels_before_ = 0;
};
#else
template <class Matrix>
using Solver = Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>;
template <class Matrix>
using Cholesky = Eigen::SimplicialLLT<Matrix, Eigen::Lower>;

/// Eigen's own solvers have one thread.
struct OneSolverThread {
  OneSolverThread() {}
};
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

#ifdef GSP_SUITESPARSE
/// Stands before libgomp's own, which CHOLMOD calls for every loop over the rows of a supernode. On one thread libgomp
/// makes a team of one for each and ends it with a system call: 400,000 for a map of the bunny, 8% of its time. Where
/// another library's symbol comes first nothing but that time is lost.
extern "C" [[gnu::visibility("default")]] void GOMP_parallel(void (*body)(void*), void* data, unsigned threads,
                                                             unsigned flags) {
  if (alone_here > 0) return body(data);
  using Parallel = void (*)(void (*)(void*), void*, unsigned, unsigned);
  static const auto libgomp = reinterpret_cast<Parallel>(dlsym(RTLD_NEXT, "GOMP_parallel"));
  libgomp(body, data, threads, flags);
}
#endif

ComplexVector solve_sparse(const ComplexMatrix& a, const ComplexVector& b) {
  if (b.size() == 0) return b;
  Solver<ComplexMatrix> solver;
  const OneSolverThread alone;
  solver.compute(a);
  require_factorized(solver, b);
  const ComplexVector x = solver.solve(b);
  return require_solved(x, a * x - b, b);
}

ComplexVector solve_hermitian(const ComplexMatrix& lower, const ComplexVector& b) {
  if (b.size() == 0) return b;
  Cholesky<ComplexMatrix> solver;
  const OneSolverThread alone;
  keep_quiet(solver);
  solver.compute(lower);
  require_factorized(solver, b);
  const ComplexVector x = solver.solve(b);
  return require_solved(x, lower.selfadjointView<Eigen::Lower>() * x - b, b);
}

bool solve_sparse(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixX2d& b, Eigen::MatrixX2d& x) {
  Solver<Eigen::SparseMatrix<double>> solver;
  const OneSolverThread alone;
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
  const OneSolverThread alone;
  if (!factor_->analysed) factor_->llt.analyzePattern(lower);
  factor_->analysed = true;
  factor_->llt.factorize(lower);
  return factor_->llt.info() == Eigen::Success;
}

Eigen::VectorXd CholeskySolver::solve(const Eigen::VectorXd& b) const {
  const OneSolverThread alone;
  return factor_->llt.solve(b);
}

}  // namespace gsp
