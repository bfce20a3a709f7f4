#include "coder/wavelet_transform.h"

#include <algorithm>
#include <string>

#include <Eigen/IterativeLinearSolvers>

#include "coder/loop_filters.h"
#include "mesh/error.h"

namespace gsp {

namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Columns columns(const std::vector<Vec3>& points) {
  Columns c(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) c.row(i) = points[i].transpose();
  return c;
}

std::vector<Vec3> points(const Columns& c, Eigen::Index first, Eigen::Index count) {
  std::vector<Vec3> p(count);
  for (Eigen::Index i = 0; i < count; ++i) p[i] = c.row(first + i).transpose();
  return p;
}

std::vector<Vec3> multiply(const SparseMatrix& matrix, const std::vector<Vec3>& x) {
  std::vector<Vec3> y(matrix.rows());
  for (Eigen::Index r = 0; r < matrix.outerSize(); ++r) {
    Vec3 sum = Vec3::Zero();
    for (SparseMatrix::InnerIterator it(matrix, r); it; ++it) sum += it.value() * x[it.col()];
    y[r] = sum;
  }
  return y;
}

/// [P Q], square.
SparseMatrix beside(const SparseMatrix& p, const SparseMatrix& q) {
  SparseMatrix both(p.rows(), p.cols() + q.cols());
  both.reserve(p.nonZeros() + q.nonZeros());
  for (Eigen::Index r = 0; r < p.rows(); ++r) {
    both.startVec(r);
    for (SparseMatrix::InnerIterator it(p, r); it; ++it) both.insertBack(r, it.col()) = it.value();
    for (SparseMatrix::InnerIterator it(q, r); it; ++it) both.insertBack(r, p.cols() + it.col()) = it.value();
  }
  both.finalize();
  return both;
}

}  // namespace

struct WaveletTransform::Impl {
  SparseMatrix low_pass, high_pass;
};

WaveletTransform::WaveletTransform(const std::vector<SubdivisionLevel>& levels) {
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
    impl_.push_back({loop_low_pass(levels[l]), loop_high_pass(levels[l])});
}

WaveletTransform::~WaveletTransform() = default;
WaveletTransform::WaveletTransform(WaveletTransform&&) noexcept = default;

int WaveletTransform::levels() const { return static_cast<int>(impl_.size()); }

std::vector<Vec3> WaveletTransform::low_pass(int level, const std::vector<Vec3>& coarse) const {
  return multiply(impl_[level].low_pass, coarse);
}

std::vector<Vec3> WaveletTransform::synthesis(int level, const std::vector<Vec3>& coarse,
                                              const std::vector<Vec3>& details) const {
  std::vector<Vec3> fine = multiply(impl_[level].low_pass, coarse);
  const std::vector<Vec3> high = multiply(impl_[level].high_pass, details);
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] += high[i];
  return fine;
}

WaveletTransform::Split WaveletTransform::analysis(int level, const std::vector<Vec3>& fine) const {
  const Impl& filters = impl_[level];
  const SparseMatrix system = beside(filters.low_pass, filters.high_pass);
  // A tolerance below what double can reach in one run: a second run on the residual takes the last digits.
  constexpr double kTolerance = 1e-13;
  Eigen::BiCGSTAB<SparseMatrix> solver;
  solver.setTolerance(kTolerance);
  solver.setMaxIterations(1000);
  solver.compute(system);
  const Columns x = columns(fine);
  Columns solution(x.rows(), 3);
  Split split;
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd right = x.col(k);
    Eigen::VectorXd unknown = solver.solve(right);
    split.iterations += static_cast<int>(solver.iterations());
    const double residual = (right - system * unknown).norm();
    if (!(residual <= 1e-10 * right.norm() + 1e-300))
      throw Error(Cause::SolverFailed, "wavelet analysis of level " + std::to_string(level) + " did not converge");
    solution.col(k) = unknown;
  }
  split.coarse = points(solution, 0, filters.low_pass.cols());
  split.details = points(solution, filters.low_pass.cols(), filters.high_pass.cols());
  return split;
}

}  // namespace gsp
