#include "remesh/displaced/control_system.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "mesh/error.h"
#include "remesh/filters/loop_limit.h"
#include "remesh/filters/loop_low_pass.h"

namespace gsp {

ControlMap::ControlMap(const std::vector<SubdivisionLevel>& levels) {
  const int count = levels.back().vertex_count;
  matrix_ = loop_limit_points(levels.back())->matrix(count, count);
  for (std::size_t l = levels.size() - 1; l-- > 0;)
    matrix_ = matrix_ * loop_low_pass(levels[l])->matrix(levels[l + 1].vertex_count, levels[l].vertex_count);
}

std::vector<Vec3> ControlMap::points(const std::vector<Vec3>& control) const {
  std::vector<Vec3> result(matrix_.rows(), Vec3::Zero());
  for (Eigen::Index r = 0; r < matrix_.rows(); ++r)
    for (SparseMatrix::InnerIterator it(matrix_, r); it; ++it) result[r] += it.value() * control[it.col()];
  return result;
}

ControlSystem::ControlSystem(const ControlMap& map, const std::vector<SubdivisionLevel>& levels)
    : map_(map),
      finest_(levels.back()),
      control_count_(levels.front().vertex_count),
      patch_shift_(2 * static_cast<int>(levels.size() - 1)),
      support_(levels.front().face_count()),
      right_(Eigen::VectorXd::Zero(3 * control_count_)) {
  for (int f = 0; f < finest_.face_count(); ++f)
    for (int v : finest_.faces[f])
      for (SparseMatrix::InnerIterator it(map.matrix(), v); it; ++it)
        support_[f >> patch_shift_].push_back(static_cast<int>(it.col()));
  for (std::vector<int>& support : support_) {
    std::sort(support.begin(), support.end());
    support.erase(std::unique(support.begin(), support.end()), support.end());
    const auto size = static_cast<Eigen::Index>(3 * support.size());
    blocks_.push_back(Eigen::MatrixXd::Zero(size, size));
  }
}

void ControlSystem::add(int face, const std::array<double, 3>& weights, const Eigen::Matrix3d& form, const Vec3& pull) {
  const int patch = face >> patch_shift_;
  const std::vector<int>& support = support_[patch];
  row_.assign(support.size(), 0.0);
  for (int k = 0; k < 3; ++k) {
    if (weights[k] == 0.0) continue;
    std::size_t i = 0;
    for (SparseMatrix::InnerIterator it(map_.matrix(), finest_.faces[face][k]); it; ++it) {
      while (support[i] != it.col()) ++i;
      row_[i] += weights[k] * it.value();
    }
  }
  Eigen::MatrixXd& block = blocks_[patch];
  for (std::size_t i = 0; i < row_.size(); ++i) {
    if (row_[i] == 0.0) continue;
    right_.segment<3>(3 * support[i]) += row_[i] * pull;
    for (std::size_t j = 0; j <= i; ++j)
      if (row_[j] != 0.0) block.block<3, 3>(3 * i, 3 * j) += (row_[i] * row_[j]) * form;
  }
}

std::vector<Vec3> ControlSystem::solve(double tether) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < support_.size(); ++p) {
    const std::vector<int>& support = support_[p];
    for (std::size_t i = 0; i < support.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        for (int x = 0; x < 3; ++x)
          for (int y = 0; y < (i == j ? x + 1 : 3); ++y)
            entries.emplace_back(3 * support[i] + x, 3 * support[j] + y, blocks_[p](3 * i + x, 3 * j + y));
  }
  const int size = 3 * control_count_;
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, tether);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw Error(Cause::SolverFailed, "the equations of the control points cannot be factorized");
  const Eigen::VectorXd solution = solver.solve(right_);
  std::vector<Vec3> moves(control_count_);
  for (int i = 0; i < control_count_; ++i) moves[i] = solution.segment<3>(3 * i);
  return moves;
}

}  // namespace gsp
