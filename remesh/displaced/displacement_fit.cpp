#include "remesh/displaced/displacement_fit.h"

#include <algorithm>

#include "mesh/parallel.h"
#include "remesh/vertex_system.h"

namespace gsp {

namespace {

class DisplacementFit {
 public:
  DisplacementFit(const SubdivisionLevel& finest, const SmoothSurface& surface, const FitTarget& target,
                  const DisplacementFitOptions& options, std::vector<SurfaceSample>& samples,
                  const std::vector<Vec3>& start)
      : finest_(finest),
        surface_(surface),
        target_(target),
        options_(options),
        samples_(samples),
        start_(start),
        moves_(start),
        free_(start.size(), 1),
        places_(target.vertex_places(finest.vertex_count)),
        squared_(samples.size()),
        squared_back_(start.size()),
        reach_(longest_edges(finest, surface.points)) {
    for (double& reach : reach_) reach *= options.reach;
  }

  std::vector<Vec3> run() {
    double energy = energy_at(moves_);
    for (int round = 0; round < options_.most_rounds; ++round) {
      const double before = energy;
      if (!step(energy) || energy > (1.0 - options_.enough) * before) break;
    }
    return std::move(moves_);
  }

 private:
  /// The quadratic form of moves along the surface.
  Eigen::Matrix3d hold(std::size_t v) const {
    const Vec3 &n = surface_.normals[v], &c = surface_.conormals[v];
    return options_.tangential * (Eigen::Matrix3d::Identity() - n * n.transpose() - c * c.transpose());
  }

  /// Also moves samples and vertices to their nearest places there.
  double energy_at(const std::vector<Vec3>& moves) {
    positions_ = surface_.points;
    for (std::size_t v = 0; v < moves.size(); ++v) positions_[v] += moves[v];
    parallel_for(samples_.size(), kSearchBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        squared_[i] = walk_to_nearest(finest_, positions_, samples_[i].point, samples_[i].place);
    });
    parallel_for(moves.size(), kSearchBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        squared_back_[v] = walk_to_nearest(target_.level, target_.positions, positions_[v], places_[v]);
    });
    double sum = 0.0;
    for (std::size_t i = 0; i < squared_.size(); ++i) sum += samples_[i].weight * squared_[i];
    for (double squared : squared_back_) sum += squared;
    for (const auto& [a, b] : finest_.edges)
      sum += options_.stiffness * (moves[a] - start_[a] - moves[b] + start_[b]).squaredNorm();
    for (std::size_t v = 0; v < moves.size(); ++v) sum += moves[v].dot(hold(v) * moves[v]);
    return sum;
  }

  /// False where no part of the step lowers the energy.
  bool step(double& energy) {
    constexpr double kShortest = 0.1;
    const std::vector<Vec3> steps = linearized().solve();
    for (double part = 1.0; part > kShortest; part /= 2.0) {
      std::vector<Vec3> moved = moves_;
      for (std::size_t v = 0; v < moved.size(); ++v) {
        const double length = steps[v].norm();
        moved[v] += (length > reach_[v] ? part * reach_[v] / length : part) * steps[v];
      }
      const double there = energy_at(moved);
      if (!(there < energy)) continue;
      energy = there;
      moves_ = std::move(moved);
      return true;
    }
    energy_at(moves_);
    return false;
  }

  VertexSystem linearized() const {
    VertexSystem system(finest_, free_);
    for (const SurfaceSample& s : samples_) {
      const auto n = direction_at(finest_, positions_, s.place, s.point);
      if (!n) continue;
      const double gap = n->dot(s.point - s.place.at(finest_, positions_));
      system.add(s.place.face, s.place.weights, s.weight * *n * n->transpose(), s.weight * gap * *n);
    }
    for (std::size_t v = 0; v < moves_.size(); ++v) {
      Eigen::Matrix3d form = hold(v);
      Vec3 pull = -(form * moves_[v]);
      form.diagonal().array() += options_.damping;
      if (const auto n = target_.direction(places_[v], positions_[v])) {
        form += *n * n->transpose();
        pull += n->dot(places_[v].at(target_.level, target_.positions) - positions_[v]) * *n;
      }
      system.add_to_vertex(static_cast<int>(v), form, pull);
    }
    for (int e = 0; e < finest_.edge_count(); ++e) {
      const auto [a, b] = finest_.edges[e];
      system.add_spring(e, options_.stiffness, -options_.stiffness * (moves_[a] - start_[a] - moves_[b] + start_[b]));
    }
    return system;
  }

  const SubdivisionLevel& finest_;
  const SmoothSurface& surface_;
  const FitTarget& target_;
  const DisplacementFitOptions options_;
  std::vector<SurfaceSample>& samples_;
  const std::vector<Vec3> start_;
  std::vector<Vec3> moves_;
  std::vector<char> free_;
  std::vector<LevelPlace> places_;  ///< of the vertices on the target
  std::vector<Vec3> positions_;
  std::vector<double> squared_, squared_back_;
  std::vector<double> reach_;
};

}  // namespace

std::vector<Vec3> fit_displacements(const SubdivisionLevel& finest, const SmoothSurface& surface,
                                    const FitTarget& target, const DisplacementFitOptions& options,
                                    std::vector<SurfaceSample>& samples, const std::vector<Vec3>& start) {
  return DisplacementFit(finest, surface, target, options, samples, start).run();
}

}  // namespace gsp
