#include "param/creases/settle_creases.h"

#include <algorithm>

#include "param/energy/lower_distortion.h"
#include "param/energy/untangle.h"
#include "param/linear/global_system.h"

namespace gsp {

namespace {

constexpr int kRings = 16;  // of the discs that are untangled
constexpr int kMostSteps = 24;
constexpr double kShortestStep = 1.0 / 64.0;
constexpr int kSweeps = 1;

/// Tells whether no fold is left.
bool untangle(Atlas& atlas, Progress& progress) {
  return repair_folds(atlas, kRings, progress).none() ||
         repair_folds(atlas, kRings, progress, UntangleToward::Equilateral).none();
}

}  // namespace

bool settle_creases(Atlas& atlas, Progress& progress) {
  const Seams& seams = atlas.surface->seams;
  if (!seams.any()) return true;
  const auto timed = progress.step("settle creases");
  Atlas settled = atlas;
  seat_boundary(settled);
  const std::vector<Complex> goal = boundary_by_arc_length(settled);
  double step = 1.0;
  for (int i = 0; i < kMostSteps && step >= kShortestStep; ++i) {
    Atlas trial = settled;
    for (int v = 0; v < static_cast<int>(goal.size()); ++v)
      if (seams.point_of(v) >= 0 && trial.patch[v] >= 0)
        trial.position[v] = step == 1.0 ? goal[v] : trial.position[v] + step * (goal[v] - trial.position[v]);
    if (!untangle(trial, progress)) {
      step *= 0.5;
      continue;
    }
    settled.position = std::move(trial.position);
    settled.reassign_all();
    if (step == 1.0) {
      atlas = std::move(settled);
      return true;
    }
    lower_distortion_locally(settled, kSweeps, progress);
    step = std::min(1.0, 2.0 * step);
  }
  return false;
}

}  // namespace gsp
