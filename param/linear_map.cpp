#include "param/linear_map.h"

#include "param/best_map.h"
#include "param/descend_corners.h"
#include "param/folds.h"
#include "param/global_system.h"
#include "param/relax_corners.h"
#include "param/repair.h"
#include "param/smooth.h"

namespace gsp {

namespace {

constexpr int kGuardedRounds = 3;
constexpr int kPatience = 2;        // rounds before the paper's iteration can be given up,
constexpr double kHopeless = 2e-4;  // where a larger share of faces is folded
constexpr int kRings = 16;          // of the discs that are untangled in the end

int move_corners(Atlas& atlas, const LinearWeights& weights, const ParameterizeOptions& options, Folding folding) {
  if (options.relaxations == 0) return 0;
  return options.corners == Corners::Gradient ? descend_corners(atlas, options.objective, kRelaxationRadius, folding)
                                              : relax_corners(atlas, weights, kRelaxationRadius, folding);
}

/// The paper's iteration (§3.3, steps 2 to 4), folds and all, as long as few faces fold. It drives corners toward a
/// conformal map, which starves long limbs until they fold.
Atlas solve_and_relax(Atlas atlas, const ParameterizeOptions& options, ParameterizeResult& result, Progress& progress) {
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
    result.flips_before_repair = static_cast<int>(folded);
    if (round >= options.relaxations || moved == 0) break;
    if (round >= kPatience && folded > kHopeless * atlas.surface->mesh.faces.size()) break;
  }
  result.relaxation_rounds = best.round();
  return best.atlas();
}

}  // namespace

Atlas linear_map(const Atlas& injective, const ParameterizeOptions& options, ParameterizeResult& result,
                 Progress& progress) {
  Atlas atlas = solve_and_relax(injective, options, result, progress);
  if (repair_folds(atlas, kRings, progress).none()) {
    atlas.reassign_all();
    return atlas;
  }
  atlas = injective;
  const LinearWeights weights(*atlas.surface, options.weights);
  BestMap best;
  for (int round = 0; round < kGuardedRounds; ++round) {
    progress.report("solve and relax without folds", double(round) / kGuardedRounds);
    move_corners(atlas, weights, options, Folding::Refused);
    result.held_vertices = solve_without_folds(atlas, weights, progress);
    best.offer(atlas, round);
  }
  result.relaxation_rounds = best.round();
  return best.atlas();
}

}  // namespace gsp
