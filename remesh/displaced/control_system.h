#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "remesh/filters/filter.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Points of Loop's limit surface at the vertices of a level, as a linear function of the base's control points.
class ControlMap {
 public:
  /// `levels`: from the base to the level. O(V), with some 15 control points to a vertex.
  explicit ControlMap(const std::vector<SubdivisionLevel>& levels);

  /// #V. `control`: #B.
  std::vector<Vec3> points(const std::vector<Vec3>& control) const;
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  SparseMatrix matrix_;
};

/// Linear equations for a move of each control point, from quadratic conditions on places of the limit surface between
/// the vertices of a level.
class ControlSystem {
 public:
  /// `levels`: those of `map`, which is kept by reference as they are.
  ControlSystem(const ControlMap& map, const std::vector<SubdivisionLevel>& levels);

  /// Of the place at `weights` in `face` of the finest level, whose move is m: ½ mᵀ form m - pullᵀ m. O(n²) in the
  /// number n of control points that the patch depends on.
  void add(int face, const std::array<double, 3>& weights, const Eigen::Matrix3d& form, const Vec3& pull);

  /// #B moves of least energy, each control point held to its place by a spring of `tether` > 0. Throws
  /// Error(SolverFailed).
  std::vector<Vec3> solve(double tether) const;

 private:
  const ControlMap& map_;
  const SubdivisionLevel& finest_;
  int control_count_;
  int patch_shift_;                        ///< two bits a level
  std::vector<std::vector<int>> support_;  ///< of each base face, the control points it depends on, ascending
  std::vector<Eigen::MatrixXd> blocks_;    ///< of each base face, lower triangle
  Eigen::VectorXd right_;
  std::vector<double> row_;  ///< of the place being added, by control point of its patch
};

}  // namespace gsp
