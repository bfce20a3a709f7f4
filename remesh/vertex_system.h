#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// Linear equations for a move of each vertex of a level, coupled along its edges: symmetric 3x3 blocks, one a vertex
/// and one an edge, that stand for the quadratic energy Σ_v (½ mᵀ D m - rᵀ m) + Σ_(a,b) m_aᵀ C m_b.
class VertexSystem {
 public:
  /// `free`: #V, the vertices that move. Both are kept by reference.
  VertexSystem(const SubdivisionLevel& level, const std::vector<char>& free);

  /// A residual of one linear function of the moves: of the place at `weights` in `face`, with the quadratic form
  /// `form` and the force `pull`.
  void add(int face, const std::array<double, 3>& weights, const Eigen::Matrix3d& form, const Vec3& pull);
  /// A spring between the ends of an edge, and one of a vertex to where it is; `pull` acts on the first end, and
  /// against it on the second.
  void add_spring(int edge, double stiffness, const Vec3& pull);
  void add_spring_to_place(int vertex, double stiffness, const Vec3& pull);
  /// The same with any quadratic form.
  void add_to_vertex(int vertex, const Eigen::Matrix3d& form, const Vec3& pull);

  /// #V moves, zero of vertices that are not free: the least energy to 1e-2 in its own norm, by conjugate gradients
  /// preconditioned by the vertices' blocks. Needs a positive definite system. O(V) an iteration, one thread.
  std::vector<Vec3> solve() const;

  /// The two sides of the equations, #V, whatever is free.
  std::vector<Vec3> times(const std::vector<Vec3>& moves) const;
  const std::vector<Vec3>& right() const { return right_; }

 private:
  const SubdivisionLevel& level_;
  const std::vector<char>& free_;
  std::vector<Eigen::Matrix3d> vertex_blocks_, edge_blocks_;
  std::vector<Vec3> right_;
};

}  // namespace gsp
