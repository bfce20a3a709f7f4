#include "remesh/vertex_system.h"

#include <Eigen/LU>

namespace gsp {

namespace {

double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
  return sum;
}

}  // namespace

VertexSystem::VertexSystem(const SubdivisionLevel& level, const std::vector<char>& free)
    : level_(level),
      free_(free),
      vertex_blocks_(free.size(), Eigen::Matrix3d::Zero()),
      edge_blocks_(level.edges.size(), Eigen::Matrix3d::Zero()),
      right_(free.size(), Vec3::Zero()) {}

void VertexSystem::add(int face, const std::array<double, 3>& weights, const Eigen::Matrix3d& form, const Vec3& pull) {
  const Triangle& corners = level_.faces[face];
  const std::array<int, 3>& sides = level_.face_edges[face];
  for (int k = 0; k < 3; ++k) {
    const double w = weights[k], next = weights[(k + 1) % 3];
    if (w == 0.0) continue;
    vertex_blocks_[corners[k]] += (w * w) * form;
    right_[corners[k]] += w * pull;
    if (next != 0.0) edge_blocks_[sides[k]] += (w * next) * form;
  }
}

void VertexSystem::add_spring(int edge, double stiffness, const Vec3& pull) {
  const auto [a, b] = level_.edges[edge];
  vertex_blocks_[a].diagonal().array() += stiffness;
  vertex_blocks_[b].diagonal().array() += stiffness;
  edge_blocks_[edge].diagonal().array() -= stiffness;
  right_[a] += pull;
  right_[b] -= pull;
}

void VertexSystem::add_spring_to_place(int vertex, double stiffness, const Vec3& pull) {
  add_to_vertex(vertex, stiffness * Eigen::Matrix3d::Identity(), pull);
}

void VertexSystem::add_to_vertex(int vertex, const Eigen::Matrix3d& form, const Vec3& pull) {
  vertex_blocks_[vertex] += form;
  right_[vertex] += pull;
}

std::vector<Vec3> VertexSystem::times(const std::vector<Vec3>& moves) const {
  std::vector<Vec3> product(moves.size());
  for (std::size_t v = 0; v < moves.size(); ++v) product[v] = vertex_blocks_[v] * moves[v];
  for (std::size_t e = 0; e < edge_blocks_.size(); ++e) {
    const auto [a, b] = level_.edges[e];
    product[a] += edge_blocks_[e] * moves[b];
    product[b] += edge_blocks_[e] * moves[a];
  }
  return product;
}

std::vector<Vec3> VertexSystem::solve() const {
  constexpr double kTolerance = 1e-2;
  constexpr int kMostIterations = 200;
  const std::size_t count = right_.size();
  std::vector<Eigen::Matrix3d> inverses(count, Eigen::Matrix3d::Zero());
  for (std::size_t v = 0; v < count; ++v)
    if (free_[v]) inverses[v] = vertex_blocks_[v].inverse();
  std::vector<Vec3> moves(count, Vec3::Zero()), residual = right_, scaled(count);
  for (std::size_t v = 0; v < count; ++v) scaled[v] = inverses[v] * residual[v];
  std::vector<Vec3> direction = scaled;
  double left = dot(residual, scaled);
  const double enough = kTolerance * kTolerance * left;
  for (int i = 0; i < kMostIterations && left > enough; ++i) {
    const std::vector<Vec3> product = times(direction);
    const double length = left / dot(direction, product);
    for (std::size_t v = 0; v < count; ++v) {
      moves[v] += length * direction[v];
      residual[v] -= length * product[v];
      scaled[v] = inverses[v] * residual[v];
    }
    const double now = dot(residual, scaled);
    for (std::size_t v = 0; v < count; ++v) direction[v] = scaled[v] + (now / left) * direction[v];
    left = now;
  }
  return moves;
}

}  // namespace gsp
