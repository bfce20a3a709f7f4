#include "remesh/displaced/displacement_fit.h"

#include <algorithm>

#include "mesh/parallel.h"
#include "remesh/displaced/edge_watch.h"
#include "remesh/vertex_system.h"

namespace gsp {

namespace {

class DisplacementFit {
 public:
  DisplacementFit(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface, const FitTarget& target,
                  const DisplacementFitOptions& options, std::vector<SurfaceSample>& samples,
                  const std::vector<Vec3>& start)
      : levels_(levels),
        finest_(levels.back()),
        surface_(surface),
        target_(target),
        options_(options),
        samples_(samples),
        start_(start),
        moves_(start),
        free_(start.size(), 1),
        places_(target.vertex_places(finest_.vertex_count)),
        squared_(samples.size()),
        squared_back_(start.size()),
        reach_(longest_edges(finest_, surface.points)),
        springs_(finest_.edge_count(), options.stiffness),
        watch_(finest_, surface.points, target, watched_edges()) {
    constexpr double kStiffer = 10.0;
    for (int e : watched_edges()) springs_[e] *= kStiffer;
    for (double& reach : reach_) reach *= options.reach;
  }

  std::vector<Vec3> run() {
    carried_ = carried_by(moves_);
    find_places(moves_);
    double energy = energy_of(moves_, carried_);
    for (int round = 0; round < options_.most_rounds; ++round) {
      const double before = energy;
      if (!step(energy) || energy > (1.0 - options_.enough) * before) break;
    }
    return std::move(moves_);
  }

 private:
  /// Beside faces of watched patches.
  std::vector<int> watched_edges() const {
    std::vector<int> edges;
    if (options_.watched.empty()) return edges;
    const int patch_shift = 2 * static_cast<int>(levels_.size() - 1);
    const auto watched = [&](int face) { return face >= 0 && options_.watched[face >> patch_shift]; };
    for (int e = 0; e < finest_.edge_count(); ++e)
      if (const auto [f, g] = finest_.edge_faces[e]; watched(f) || watched(g)) edges.push_back(e);
    return edges;
  }

  /// The quadratic form of moves along the surface.
  Eigen::Matrix3d hold(std::size_t v) const {
    const Vec3 &n = surface_.normals[v], &c = surface_.conormals[v];
    return options_.tangential * (Eigen::Matrix3d::Identity() - n * n.transpose() - c * c.transpose());
  }

  /// Where the boundary's part of moves leaves the vertices inside.
  std::vector<Vec3> carried_by(const std::vector<Vec3>& moves) const {
    std::vector<double> across(moves.size());
    for (std::size_t v = 0; v < across.size(); ++v) across[v] = surface_.conormals[v].dot(moves[v]);
    return moves_across(levels_, surface_, across);
  }

  /// Lets vertices inside go on with the boundary from where `carried_` has left them.
  void follow(std::vector<Vec3>& moves, const std::vector<Vec3>& carried) const {
    for (std::size_t v = 0; v < moves.size(); ++v)
      if (surface_.conormals[v].isZero(0.0)) moves[v] += carried[v] - carried_[v];
  }

  /// Moves samples and vertices to their nearest places, which `energy_of` then takes.
  void find_places(const std::vector<Vec3>& moves) {
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
    watch_.find_places(positions_);
  }

  double energy_of(const std::vector<Vec3>& moves, const std::vector<Vec3>& carried) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < squared_.size(); ++i) sum += samples_[i].weight * squared_[i];
    for (double squared : squared_back_) sum += squared;
    sum += watch_.energy();
    for (int e = 0; e < finest_.edge_count(); ++e) {
      const auto [a, b] = finest_.edges[e];
      sum += springs_[e] * (moves[a] - start_[a] - moves[b] + start_[b]).squaredNorm();
    }
    for (std::size_t v = 0; v < moves.size(); ++v) {
      const Vec3 off = moves[v] - carried[v];
      sum += off.dot(hold(v) * off);
    }
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
      std::vector<Vec3> carried = carried_by(moved);
      follow(moved, carried);
      find_places(moved);
      const double there = energy_of(moved, carried);
      if (!(there < energy)) continue;
      energy = there;
      moves_ = std::move(moved);
      carried_ = std::move(carried);
      return true;
    }
    find_places(moves_);
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
      Vec3 pull = -(form * (moves_[v] - carried_[v]));
      form.diagonal().array() += options_.damping;
      if (const auto n = target_.direction(places_[v], positions_[v])) {
        form += *n * n->transpose();
        pull += n->dot(places_[v].at(target_.level, target_.positions) - positions_[v]) * *n;
      }
      system.add_to_vertex(static_cast<int>(v), form, pull);
    }
    watch_.add_to(system);
    for (int e = 0; e < finest_.edge_count(); ++e) {
      const auto [a, b] = finest_.edges[e];
      system.add_spring(e, springs_[e], -springs_[e] * (moves_[a] - start_[a] - moves_[b] + start_[b]));
    }
    return system;
  }

  const std::vector<SubdivisionLevel>& levels_;
  const SubdivisionLevel& finest_;
  const SmoothSurface& surface_;
  const FitTarget& target_;
  const DisplacementFitOptions options_;
  std::vector<SurfaceSample>& samples_;
  const std::vector<Vec3> start_;
  std::vector<Vec3> moves_;
  std::vector<Vec3> carried_;  ///< #V, the part of them that the boundary's displacements give
  std::vector<char> free_;
  std::vector<LevelPlace> places_;  ///< of the vertices on the target
  std::vector<Vec3> positions_;
  std::vector<double> squared_, squared_back_;
  std::vector<double> reach_;
  std::vector<double> springs_;  ///< #E, their stiffness
  EdgeWatch watch_;
};

}  // namespace

std::vector<Vec3> fit_displacements(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                                    const FitTarget& target, const DisplacementFitOptions& options,
                                    std::vector<SurfaceSample>& samples, const std::vector<Vec3>& start) {
  return DisplacementFit(levels, surface, target, options, samples, start).run();
}

}  // namespace gsp
