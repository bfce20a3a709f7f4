#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/closest_fit.h"
#include "remesh/filters/filter.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Points of a level on Loop's limit surface as a linear function of the base's control points.
class ControlMap {
 public:
  /// `levels`: from the base to the level.
  explicit ControlMap(const std::vector<SubdivisionLevel>& levels);

  std::vector<Vec3> points(const std::vector<Vec3>& control) const;
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  SparseMatrix matrix_;
};

/// Least squares for moves of control points from linear conditions on places of the surface.
class ControlSystem {
 public:
  ControlSystem(const ControlMap& map, const SubdivisionLevel& base, const SubdivisionLevel& finest, int level);

  /// |form^(1/2) (move of the place) - ...|²: quadratic form and pull of the place at `weights` in `face`.
  void add(int face, const std::array<double, 3>& weights, const Eigen::Matrix3d& form, const Vec3& pull);
  void add_tether(double stiffness);
  void add_spring(int a, int b, double stiffness, const Vec3& pull);
  std::vector<Vec3> solve();

 private:
  void flush(int patch);
  const ControlMap& map_;
  const SubdivisionLevel& finest_;
  int level_, control_count_;
  std::vector<std::vector<int>> support_;   ///< of each base face
  std::vector<Eigen::MatrixXd> blocks_;
  Eigen::VectorXd right_;
  double tether_ = 0.0;
  std::vector<Eigen::Triplet<double>> springs_;
};

}  // namespace gsp
