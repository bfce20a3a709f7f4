#include "remesh/displaced/control_fit.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "remesh/filters/loop_limit.h"
#include "remesh/filters/loop_low_pass.h"

namespace gsp {

ControlMap::ControlMap(const std::vector<SubdivisionLevel>& levels) {
  const int n = levels.back().vertex_count;
  matrix_ = loop_limit_points(levels.back())->matrix(n, n);
  for (std::size_t l = levels.size() - 1; l-- > 0;)
    matrix_ = matrix_ * loop_low_pass(levels[l])->matrix(levels[l + 1].vertex_count, levels[l].vertex_count);
}

std::vector<Vec3> ControlMap::points(const std::vector<Vec3>& control) const {
  std::vector<Vec3> result(matrix_.rows(), Vec3::Zero());
  for (Eigen::Index r = 0; r < matrix_.rows(); ++r)
    for (SparseMatrix::InnerIterator it(matrix_, r); it; ++it) result[r] += it.value() * control[it.col()];
  return result;
}

ControlSystem::ControlSystem(const ControlMap& map, const SubdivisionLevel& base, const SubdivisionLevel& finest,
                             int level)
    : map_(map), finest_(finest), level_(level), control_count_(base.vertex_count) {
  support_.resize(base.face_count());
  for (int f = 0; f < finest.face_count(); ++f)
    for (int v : finest.faces[f])
      for (SparseMatrix::InnerIterator it(map.matrix(), v); it; ++it) {
        std::vector<int>& s = support_[f >> (2 * level)];
        if (std::find(s.begin(), s.end(), it.col()) == s.end()) s.push_back(static_cast<int>(it.col()));
      }
  for (std::vector<int>& s : support_) {
    std::sort(s.begin(), s.end());
    blocks_.push_back(Eigen::MatrixXd::Zero(3 * s.size(), 3 * s.size()));
  }
  right_ = Eigen::VectorXd::Zero(3 * control_count_);
}

void ControlSystem::add(int face, const std::array<double, 3>& weights, const Eigen::Matrix3d& form, const Vec3& pull) {
  const int patch = face >> (2 * level_);
  const std::vector<int>& s = support_[patch];
  std::array<double, 256> row{};
  const std::size_t n = std::min<std::size_t>(s.size(), row.size());
  for (int k = 0; k < 3; ++k) {
    std::size_t i = 0;
    for (SparseMatrix::InnerIterator it(map_.matrix(), finest_.faces[face][k]); it; ++it) {
      while (s[i] != it.col()) ++i;
      row[i] += weights[k] * it.value();
    }
  }
  Eigen::MatrixXd& block = blocks_[patch];
  for (std::size_t i = 0; i < n; ++i) {
    if (row[i] == 0.0) continue;
    right_.segment<3>(3 * s[i]) += row[i] * pull;
    for (std::size_t j = 0; j <= i; ++j)
      if (row[j] != 0.0) block.block<3, 3>(3 * i, 3 * j) += (row[i] * row[j]) * form;
  }
}

void ControlSystem::add_tether(double stiffness) { tether_ += stiffness; }

void ControlSystem::add_spring(int a, int b, double stiffness, const Vec3& pull) {
  if (a < b) std::swap(a, b);
  for (int x = 0; x < 3; ++x) {
    springs_.emplace_back(3 * a + x, 3 * a + x, stiffness);
    springs_.emplace_back(3 * b + x, 3 * b + x, stiffness);
    springs_.emplace_back(3 * a + x, 3 * b + x, -stiffness);
  }
  right_.segment<3>(3 * a) += pull;
  right_.segment<3>(3 * b) -= pull;
}

std::vector<Vec3> ControlSystem::solve() {
  std::vector<Eigen::Triplet<double>> entries = springs_;
  for (std::size_t p = 0; p < support_.size(); ++p) {
    const std::vector<int>& s = support_[p];
    for (std::size_t i = 0; i < s.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        for (int x = 0; x < 3; ++x)
          for (int y = 0; y < (i == j ? x + 1 : 3); ++y)
            entries.emplace_back(3 * s[i] + x, 3 * s[j] + y, blocks_[p](3 * i + x, 3 * j + y));
  }
  for (int i = 0; i < 3 * control_count_; ++i) entries.emplace_back(i, i, tether_);
  Eigen::SparseMatrix<double> matrix(3 * control_count_, 3 * control_count_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
  const Eigen::VectorXd x = solver.solve(right_);
  std::vector<Vec3> moves(control_count_);
  for (int i = 0; i < control_count_; ++i) moves[i] = x.segment<3>(3 * i);
  return moves;
}

}  // namespace gsp
