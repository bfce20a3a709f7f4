#include "remesh/fit_positions.h"

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "remesh/chart_samples.h"
#include "remesh/fold_guard.h"

namespace gsp {

namespace {

/// Weights of the composite trapezoid rule, which sum to 1: of a point by how many of its three weights are zero.
double face_weight(int steps, int s, int t) {
  const int zeros = (s == 0) + (t == 0) + (s + t == steps);
  const double cells = zeros == 0 ? 6.0 : zeros == 1 ? 3.0 : 1.0;
  return cells / (3.0 * steps * steps);
}

double edge_weight(int steps, int s) { return (s == 0 || s == steps ? 0.5 : 1.0) / steps; }

/// Of an element whose corners are all alike, the products of a hat function with itself and with another.
struct ElementProducts {
  double own = 0.0, other = 0.0;
};

// By the same quadrature as the moments, so that a linear surface is met exactly.
ElementProducts face_products(int steps) {
  ElementProducts sum;
  for (int t = 0; t <= steps; ++t)
    for (int s = 0; s + t <= steps; ++s) {
      const double weight = face_weight(steps, s, t) / (static_cast<double>(steps) * steps);
      sum.own += weight * s * s;
      sum.other += weight * s * t;
    }
  return sum;
}

ElementProducts edge_products(int steps) {
  ElementProducts sum;
  for (int s = 0; s <= steps; ++s) {
    const double weight = edge_weight(steps, s) / (static_cast<double>(steps) * steps);
    sum.own += weight * s * s;
    sum.other += weight * s * (steps - s);
  }
  return sum;
}

/// A sum of squares over elements: gradient zero where, for every vertex, matrix times positions is the moment.
class LeastSquares {
 public:
  explicit LeastSquares(std::size_t vertices) : diagonal_(vertices, 0.0), moments_(vertices, Vec3::Zero()) {}

  template <std::size_t N, class Corners>
  void add(const Corners& corners, const ElementProducts& products, const std::array<Vec3, N>& moments) {
    for (std::size_t k = 0; k < N; ++k) {
      diagonal_[corners[k]] += products.own;
      moments_[corners[k]] += moments[k];
      for (std::size_t l = k + 1; l < N; ++l) couplings_.push_back({corners[k], corners[l], products.other});
    }
  }

  /// Moves the vertices marked in `free` to the minimum with the others held.
  void solve(const std::vector<char>& free, std::vector<Vec3>& positions) const {
    const std::vector<Vec3> residual = residuals(positions);
    std::vector<int> vertices, unknown(free.size(), -1);
    double largest = 0.0;
    for (std::size_t v = 0; v < free.size(); ++v) {
      if (!free[v]) continue;
      unknown[v] = static_cast<int>(vertices.size());
      vertices.push_back(static_cast<int>(v));
      largest = std::max(largest, residual[v].cwiseAbs().maxCoeff());
    }
    if (!(largest > 0.0) || !std::isfinite(largest)) return;
    const Eigen::SparseMatrix<double> matrix = restricted(vertices, unknown);
    // A mass matrix: with its diagonal taken out its condition is below ten at any size, so a few dozen steps do.
    constexpr double kTolerance = 1e-12;
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
    solver.setTolerance(kTolerance);
    Eigen::VectorXd right(vertices.size());
    for (int c = 0; c < 3; ++c) {
      // In units of the largest, so that no square overflows.
      for (std::size_t i = 0; i < vertices.size(); ++i) right[i] = residual[vertices[i]][c] / largest;
      const Eigen::VectorXd moves = solver.solve(right);
      for (std::size_t i = 0; i < vertices.size(); ++i) positions[vertices[i]][c] += moves[i] * largest;
    }
  }

 private:
  struct Coupling {
    int a, b;
    double value;
  };

  std::vector<Vec3> residuals(const std::vector<Vec3>& positions) const {
    std::vector<Vec3> residual = moments_;
    for (std::size_t v = 0; v < residual.size(); ++v) residual[v] -= diagonal_[v] * positions[v];
    for (const Coupling& c : couplings_) {
      residual[c.a] -= c.value * positions[c.b];
      residual[c.b] -= c.value * positions[c.a];
    }
    return residual;
  }

  Eigen::SparseMatrix<double> restricted(const std::vector<int>& vertices, const std::vector<int>& unknown) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(vertices.size() + 2 * couplings_.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int row = static_cast<int>(i);
      entries.emplace_back(row, row, diagonal_[vertices[i]]);
    }
    for (const Coupling& c : couplings_) {
      const int a = unknown[c.a], b = unknown[c.b];
      if (a < 0 || b < 0) continue;
      entries.emplace_back(a, b, c.value);
      entries.emplace_back(b, a, c.value);
    }
    const auto size = static_cast<Eigen::Index>(vertices.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  std::vector<double> diagonal_;
  std::vector<Vec3> moments_;
  std::vector<Coupling> couplings_;
};

/// #V, whether a crease ends at a vertex or meets others.
std::vector<char> crease_ends(const SubdivisionLevel& level) {
  std::vector<char> ends;
  for (const VertexFan& fan : vertex_fans(level)) ends.push_back(fan.crease_count > 0 && !fan.on_curve());
  return ends;
}

}  // namespace

PositionFit::PositionFit(const SubdivisionLevel& finest, int steps)
    : finest_(finest),
      steps_(steps),
      doubled_areas_(finest.faces.size()),
      face_moments_(finest.faces.size()),
      place_(finest.edges.size(), -1) {
  for (int e = 0; e < finest.edge_count(); ++e) {
    if (!finest.sharp(e)) continue;
    place_[e] = static_cast<int>(sharp_edges_.size());
    sharp_edges_.push_back(e);
  }
  edge_moments_.resize(sharp_edges_.size());
}

void PositionFit::add_face(int face, const std::vector<Vec3>& points) {
  std::array<Vec3, 3> moments = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int t = 0; t <= steps_; ++t)
    for (int s = 0; s + t <= steps_; ++s) {
      const Vec3 weighted = face_weight(steps_, s, t) / steps_ * points[lattice_index(steps_, s, t)];
      moments[0] += (steps_ - s - t) * weighted;
      moments[1] += s * weighted;
      moments[2] += t * weighted;
    }
  face_moments_[face] = moments;
  // It follows from the border alone.
  Vec3 area = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    for (int s = 0; s < steps_; ++s) {
      const auto [s0, t0] = along_side(steps_, k, s);
      const auto [s1, t1] = along_side(steps_, k, s + 1);
      const Vec3 from = points[lattice_index(steps_, s0, t0)] - points[0];
      area += from.cross(points[lattice_index(steps_, s1, t1)] - points[0]);
    }
  doubled_areas_[face] = area;
  for (int k = 0; k < 3; ++k) {
    const int edge = finest_.face_edges[face][k], place = place_[edge];
    // Of a crease both faces have the same points.
    if (place < 0 || finest_.edge_faces[edge][0] != face) continue;
    edge_moments_[place] = {Vec3::Zero(), Vec3::Zero()};
    for (int s = 0; s <= steps_; ++s) {
      const auto [i, j] = along_side(steps_, k, s);
      const Vec3 weighted = edge_weight(steps_, s) / steps_ * points[lattice_index(steps_, i, j)];
      edge_moments_[place][0] += (steps_ - s) * weighted;
      edge_moments_[place][1] += s * weighted;
    }
  }
}

std::vector<Vec3> PositionFit::fit(const std::vector<Vec3>& sampled) const {
  std::vector<char> on_curve(sampled.size(), 0);
  LeastSquares curves(sampled.size()), surface(sampled.size());
  const ElementProducts along = edge_products(steps_), within = face_products(steps_);
  for (std::size_t i = 0; i < sharp_edges_.size(); ++i) {
    const std::array<int, 2>& ends = finest_.edges[sharp_edges_[i]];
    curves.add(ends, along, edge_moments_[i]);
    for (int v : ends) on_curve[v] = 1;
  }
  for (int f = 0; f < finest_.face_count(); ++f) surface.add(finest_.faces[f], within, face_moments_[f]);

  std::vector<Vec3> positions = sampled;
  std::vector<char> held = crease_ends(finest_), free(sampled.size());
  const FoldGuard guard(finest_, doubled_areas_);
  // Each round but the last holds a vertex more, and a face whose corners all are held is that of the samples.
  do {
    for (std::size_t v = 0; v < held.size(); ++v) {
      if (held[v]) positions[v] = sampled[v];
      free[v] = on_curve[v] && !held[v];
    }
    curves.solve(free, positions);
    for (std::size_t v = 0; v < held.size(); ++v) free[v] = !on_curve[v] && !held[v];
    surface.solve(free, positions);
  } while (guard.hold(sampled, positions, held));
  return positions;
}

}  // namespace gsp
