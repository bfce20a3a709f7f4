#include "remesh/displaced/scalar_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh/fixed_order.h"
#include "mesh/parallel.h"
#include "remesh/vertex_system.h"

namespace gsp {

namespace {

class DisplacementFit {
 public:
  DisplacementFit(const SubdivisionLevel& finest, const SmoothSurface& surface, std::vector<SurfaceSample>& samples,
            const ScalarFitOptions& options, const std::vector<Vec3>& start, SampledSurface& back)
      : finest_(finest), surface_(surface), samples_(samples), options_(options), back_(back), start_(start), moves_(start), free_(start.size(), 1),
        squared_(samples.size()), squared_back_(start.size()), reach_(start.size(), 0.0), face_(start.size(), {0, 0}) {
    for (const auto& [a, b] : finest.edges) {
      const double length = options.reach * (surface.points[a] - surface.points[b]).norm();
      reach_[a] = std::max(reach_[a], length);
      reach_[b] = std::max(reach_[b], length);
    }
    for (int f = 0; f < finest.face_count(); ++f)
      for (int k = 0; k < 3; ++k) face_[finest.faces[f][k]] = {f, k};
  }

  std::vector<Vec3> run() {
    double energy = energy_at(moves_);
    for (int round = 0; round < options_.most_rounds; ++round) {
      const double before = energy;
      const std::vector<Vec3> step = linearized().solve();
      bool lower = false;
      for (double part = 1.0; part > 0.1; part /= 2) {
        std::vector<Vec3> moved = moves_;
        for (std::size_t v = 0; v < moved.size(); ++v) {
          const double length = step[v].norm();
          moved[v] += part * std::min(1.0, reach_[v] / std::max(length, 1e-300)) * step[v];
        }
        const double there = energy_at(moved);
        if (!(there < energy)) continue;
        energy = there;
        moves_ = moved;
        lower = true;
        break;
      }
      if (!lower || energy > (1.0 - options_.enough) * before) break;
    }
    return moves_;
  }

 private:
  Eigen::Matrix3d hold(int v) const {
    const Vec3& n = surface_.normals[v];
    return options_.tangential * (Eigen::Matrix3d::Identity() - n * n.transpose());
  }
  void place(const std::vector<Vec3>& moves) {
    positions_ = surface_.points;
    for (std::size_t v = 0; v < moves.size(); ++v) positions_[v] += moves[v];
  }
  double energy_at(const std::vector<Vec3>& moves) {
    place(moves);
    parallel_for(samples_.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        squared_[i] = walk_to_nearest(finest_, positions_, samples_[i].point, samples_[i].place);
    });
    parallel_for(moves.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        squared_back_[v] = walk_to_nearest(*back_.level, *back_.positions, positions_[v], back_.places[v]);
    });
    double sum = 0.0;
    for (std::size_t i = 0; i < squared_.size(); ++i) sum += samples_[i].weight * squared_[i];
    for (double d : squared_back_) sum += back_.weight * d;
    for (const auto& [a, b] : finest_.edges) sum += options_.stiffness * (moves[a] - start_[a] - moves[b] + start_[b]).squaredNorm();
    for (std::size_t v = 0; v < moves.size(); ++v) sum += moves[v].dot(hold(v) * moves[v]);
    return sum;
  }

  VertexSystem linearized() {
    place(moves_);
    VertexSystem system(finest_, free_);
    for (const SurfaceSample& sample : samples_) {
      const Triangle& t = finest_.faces[sample.place.face];
      const Vec3 gap = sample.point - sample.place.at(finest_, positions_);
      const auto n = unit(sample.place.inside_face() ? doubled_area(t, positions_) : gap);
      if (n) system.add(sample.place.face, sample.place.weights, sample.weight * *n * n->transpose(), sample.weight * dot(gap, *n) * *n);
    }
    for (std::size_t v = 0; v < moves_.size(); ++v) {
      const LevelPlace& place = back_.places[v];
      const Vec3 gap = place.at(*back_.level, *back_.positions) - positions_[v];
      const auto n = unit(place.inside_face() ? doubled_area(back_.level->faces[place.face], *back_.positions) : gap);
      Eigen::Matrix3d form = hold(v);
      Vec3 pull = -(form * moves_[v]);
      form.diagonal().array() += options_.damping;
      if (n) {
        form += back_.weight * *n * n->transpose();
        pull += back_.weight * dot(gap, *n) * *n;
      }
      std::array<double, 3> corner = {0.0, 0.0, 0.0};
      corner[face_[v].second] = 1.0;
      system.add(face_[v].first, corner, form, pull);
    }
    for (int e = 0; e < finest_.edge_count(); ++e) {
      const auto [a, b] = finest_.edges[e];
      system.add_spring(e, options_.stiffness, -options_.stiffness * (moves_[a] - start_[a] - moves_[b] + start_[b]));
    }
    return system;
  }

  const SubdivisionLevel& finest_;
  const SmoothSurface& surface_;
  std::vector<SurfaceSample>& samples_;
  const ScalarFitOptions options_;
  SampledSurface& back_;
  const std::vector<Vec3> start_;
  std::vector<Vec3> moves_;
  std::vector<char> free_;
  std::vector<Vec3> positions_;
  std::vector<double> squared_, squared_back_;
  std::vector<double> reach_;
  std::vector<std::pair<int, int>> face_;
};

}  // namespace

std::vector<Vec3> displaced_points(const SmoothSurface& surface, const std::vector<double>& scalars) {
  std::vector<Vec3> points = surface.points;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (int k = 0; k < 3; ++k) points[v][k] += scalars[v] * surface.normals[v][k];
  return points;
}

std::vector<Vec3> fit_displacements(const SubdivisionLevel& finest, const SmoothSurface& surface,
                                std::vector<SurfaceSample>& samples, const ScalarFitOptions& options,
                                const std::vector<Vec3>& start, SampledSurface& back) {
  return DisplacementFit(finest, surface, samples, options, start, back).run();
}

}  // namespace gsp
