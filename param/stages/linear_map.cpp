#include "param/stages/linear_map.h"

#include "param/atlas/best_map.h"
#include "param/atlas/folds.h"
#include "param/atlas/mend_charts.h"
#include "param/corners/descend_corners.h"
#include "param/corners/relax_corners.h"
#include "param/energy/untangle.h"
#include "param/linear/global_system.h"
#include "param/stages/fold_free_solution.h"

namespace gsp {

namespace {

constexpr int kGuardedRounds = 3;
constexpr int kPatience = 2;         // rounds before the paper's iteration can be given up,
constexpr double kHopeless = 2e-4;   // where a larger share of faces is folded
constexpr int kUntangledRings = 16;  // of the discs that are untangled in the end

int move_corners(Atlas& atlas, const LinearWeights& weights, const ParameterizeOptions& options, Folding folding) {
  if (options.relaxations == 0) return 0;
  return options.corners == Corners::Gradient ? descend_corners(atlas, options.objective, kRelaxationRadius, folding)
                                              : relax_corners(atlas, weights, kRelaxationRadius, folding);
}

/// The paper's iteration (§3.3, steps 2 to 4), folds and all, as long as few faces fold. It drives corners toward a
/// conformal map, which starves long limbs until they fold.
Atlas solve_and_relax(Atlas atlas, const ParameterizeOptions& options, SmoothingRecord& record, Progress& progress) {
  atlas.position = boundary_by_arc_length(atlas);
  const LinearWeights weights(*atlas.surface, options.weights);
  BestMap best;
  for (int round = 0;; ++round) {
    progress.report("solve and relax", double(round) / (options.relaxations + 1));
    const int moved = move_corners(atlas, weights, options, Folding::Allowed);
    atlas.position = solve_global(atlas, weights, interior_vertices(atlas));
    atlas.reassign_all();
    best.offer(atlas, round);
    const std::size_t folded = find_folds(atlas).faces.size();
    record.flips_before_repair = static_cast<int>(folded);
    if (round >= options.relaxations || moved == 0) break;
    if (round >= kPatience && folded > kHopeless * atlas.surface->mesh.faces.size()) break;
  }
  record.rounds = best.round();
  return best.atlas();
}

}  // namespace

SmoothedMap linear_map(const Atlas& injective, const ParameterizeOptions& options, Progress& progress) {
  SmoothingRecord record;
  Atlas atlas = solve_and_relax(injective, options, record, progress);
  if (repair_folds(atlas, kUntangledRings, progress).none()) {
    atlas.reassign_all();
    // A solution that folds about a corner has carried vertices beyond it, into charts of another sector.
    mend_charts(atlas);
    return {std::move(atlas), record};
  }
  atlas = injective;
  const LinearWeights weights(*atlas.surface, options.weights);
  BestMap best;
  for (int round = 0; round < kGuardedRounds; ++round) {
    progress.report("solve and relax without folds", double(round) / kGuardedRounds);
    move_corners(atlas, weights, options, Folding::Refused);
    record.held_vertices = solve_without_folds(atlas, weights, progress);
    best.offer(atlas, round);
  }
  record.rounds = best.round();
  return {best.atlas(), record};
}

}  // namespace gsp
