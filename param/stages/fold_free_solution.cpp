#include "param/stages/fold_free_solution.h"

#include <algorithm>

#include "param/atlas/folds.h"
#include "param/energy/untangle.h"
#include "param/linear/global_system.h"

namespace gsp {

namespace {

constexpr int kFewRings = 4;  // held around a fold where a shorter step could still do without
constexpr int kRings = 4;     // of the discs that are untangled
constexpr int kManyRings = 64;
constexpr double kShortestStep = 1.0 / 16.0;
constexpr int kMostSteps = 12;

/// Carries a map free of folds toward a goal, without folds.
class Approach {
 public:
  /// `goal`: #V positions in the charts of `atlas`, which do not change meanwhile.
  Approach(Atlas& atlas, std::vector<Complex> goal, Progress& progress)
      : atlas_(atlas), goal_(std::move(goal)), progress_(progress) {}

  int run() {
    double step = 1.0;
    for (int i = 0; i < kMostSteps && step >= kShortestStep; ++i) {
      const bool made = advance(step, kFewRings);
      if (made && step == 1.0) return held_;
      step = made ? std::min(1.0, 2.0 * step) : 0.5 * step;
    }
    for (step = 1.0; step >= kShortestStep; step *= 0.5) {
      if (advance(step, kManyRings)) break;
    }
    return held_;
  }

 private:
  /// Goes the given share of the way, all vertices but those within so many rings of a fold that cannot be untangled.
  bool advance(double step, int most_rings) {
    Atlas trial = atlas_;
    std::vector<double> share(goal_.size(), step);
    held_ = 0;
    for (int rings = 1;; rings *= 2) {
      for (std::size_t v = 0; v < goal_.size(); ++v)
        trial.position[v] = atlas_.position[v] + share[v] * (goal_[v] - atlas_.position[v]);
      const Folds folds = repair_folds(trial, kRings, progress_);
      if (folds.none()) break;
      if (rings > most_rings) return false;
      const std::vector<int> distance = rings_around(*atlas_.surface, folds, 3 * rings).distance;
      held_ = 0;
      for (std::size_t v = 0; v < goal_.size(); ++v) {
        if (distance[v] >= 0) share[v] *= std::clamp(0.5 * (distance[v] - rings) / rings, 0.0, 1.0);
        held_ += share[v] == 0.0;
      }
    }
    atlas_.position = std::move(trial.position);
    return true;
  }

  Atlas& atlas_;
  const std::vector<Complex> goal_;
  Progress& progress_;
  int held_ = 0;
};

}  // namespace

int solve_without_folds(Atlas& atlas, const LinearWeights& weights, Progress& progress) {
  seat_boundary(atlas);
  Atlas goal = atlas;
  goal.position = boundary_by_arc_length(atlas);
  const int held = Approach(atlas, solve_global(goal, weights, interior_vertices(goal)), progress).run();
  atlas.reassign_all();
  return held;
}

}  // namespace gsp
