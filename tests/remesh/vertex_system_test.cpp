#include "remesh/vertex_system.h"

#include <catch2/catch.hpp>

#include <Eigen/Cholesky>
#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"

using namespace gsp;

TEST_CASE("a vertex system's moves are those of the whole matrix, to the energy's thousandth") {
  const Mesh mesh = shapes::icosahedron();
  const SubdivisionLevel level = base_level(mesh.vertex_count(), mesh.faces);
  const int n = level.vertex_count;
  std::vector<char> free(n, 1);
  free[3] = 0;
  VertexSystem system(level, free);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * n);
  Random random(1);
  const auto vector = [&] { return Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5); };
  // Twice the half energy of each residual of the moves: (normal · Σ weight move)² / 2 - pull · Σ weight move.
  for (int i = 0; i < 200; ++i) {
    const int face = static_cast<int>(random.uniform() * level.face_count());
    const double a = random.uniform(), b = (1.0 - a) * random.uniform();
    const std::array<double, 3> weights = {a, b, i % 3 == 0 ? 0.0 : 1.0 - a - b};
    const Vec3 normal = vector(), pull = vector();
    system.add(face, weights, normal * normal.transpose(), pull);
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(3, 3 * n);
    for (int k = 0; k < 3; ++k) row.middleCols<3>(3 * level.faces[face][k]) += weights[k] * Eigen::Matrix3d::Identity();
    matrix += row.transpose() * normal * normal.transpose() * row;
    right += row.transpose() * pull;
  }
  for (int e = 0; e < level.edge_count(); ++e) {
    const auto [a, b] = level.edges[e];
    const Vec3 pull = vector();
    system.add_spring(e, 0.3, pull);
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(3, 3 * n);
    row.middleCols<3>(3 * a).setIdentity();
    row.middleCols<3>(3 * b) = -Eigen::Matrix3d::Identity();
    matrix += 0.3 * row.transpose() * row;
    right += row.transpose() * pull;
  }
  for (int v = 0; v < n; ++v) {
    const Vec3 pull = vector();
    system.add_spring_to_place(v, 0.1, pull);
    matrix.diagonal().segment<3>(3 * v).array() += 0.1;
    right.segment<3>(3 * v) += pull;
  }
  matrix.middleRows<3>(9).setZero();
  matrix.middleCols<3>(9).setZero();
  matrix.diagonal().segment<3>(9).setOnes();
  right.segment<3>(9).setZero();
  const Eigen::VectorXd exact = matrix.llt().solve(right);
  const std::vector<Vec3> moves = system.solve();
  Eigen::VectorXd error = -exact;
  for (int v = 0; v < n; ++v) error.segment<3>(3 * v) += moves[v];
  CHECK(moves[3].norm() == 0.0);
  CHECK(error.dot(matrix * error) < 1e-3 * exact.dot(matrix * exact));
}

TEST_CASE("of a vertex system without a force nothing moves") {
  const Mesh mesh = shapes::tetrahedron();
  const SubdivisionLevel level = base_level(mesh.vertex_count(), mesh.faces);
  const std::vector<char> free(4, 1);
  VertexSystem system(level, free);
  for (int v = 0; v < 4; ++v) system.add_spring_to_place(v, 1.0, Vec3::Zero());
  for (const Vec3& move : system.solve()) CHECK(move.norm() == 0.0);
}
