#include "param/stages/smooth_levels.h"

#include "param/atlas/best_map.h"
#include "param/atlas/mend_charts.h"
#include "param/corners/choose_base_flips.h"
#include "param/corners/descend_corners.h"
#include "param/corners/relax_corners.h"
#include "param/creases/settle_creases.h"
#include "param/energy/lower_distortion.h"
#include "param/linear/weights.h"
#include "param/reinsert/reinsertion.h"

namespace gsp {

namespace {

constexpr double kRoughly = 2e-3,
                 kFinely = 1e-4;  // gain of a step that ends lowering the distortion, between and after relaxations
constexpr int kSweeps = 1;
constexpr int kWhole = 20000;  // vertices up to which the whole map is smoothed at once, after each relaxation too

int relax_or_descend(Atlas& atlas, const ParameterizeOptions& options, Progress& progress) {
  const auto step = progress.step("move corners");
  if (options.corners == Corners::Gradient)
    return descend_corners(atlas, Objective::Distortion, kRelaxationRadius, Folding::Refused);
  return relax_corners(atlas, LinearWeights(*atlas.surface, options.weights), kRelaxationRadius, Folding::Refused);
}

/// Takes out added vertices that the map has come to need no more.
void coarsen_map(EditableAtlas& map, Progress& progress) {
  const auto step = progress.step("take out added vertices");
  map = coarsen(std::move(map));
  map.atlas.reassign_all();
}

/// The whole map at once.
SmoothingRecord smooth_coarsest(EditableAtlas& map, const ParameterizeOptions& options, bool finest,
                                Progress& progress) {
  const bool large = map.atlas.surface->mesh.vertex_count() > kWhole;
  if (large) lower_distortion_locally(map.atlas, kSweeps, progress);
  lower_distortion(map.atlas, kRoughly, progress);
  coarsen_map(map, progress);
  const auto lower_again = [&] {
    if (large)  // what corners and base edges have changed is local
      lower_distortion_locally(map.atlas, kSweeps, progress);
    else
      lower_distortion(map.atlas, kRoughly, progress);
  };
  int flipped = 0;
  const auto flip = [&] {
    const int more = options.base_edges == BaseEdges::Flip ? flip_base_edges(map.atlas, progress) : 0;
    if (more > 0) lower_again();
    flipped += more;
  };
  flip();
  BestMap best;
  best.offer(map.atlas, 0);
  std::vector<int> flipped_by{flipped};
  for (int round = 1; round <= options.relaxations; ++round) {
    if (relax_or_descend(map.atlas, options, progress) == 0) break;
    lower_again();
    flip();
    best.offer(map.atlas, round);
    flipped_by.push_back(flipped);
  }
  map.atlas = best.atlas();
  lower_distortion(map.atlas, finest ? kFinely : kRoughly, progress);
  return {best.round(), flipped_by[best.round()]};
}

/// A map that a coarser level has made smooth on the large.
void smooth_finer(EditableAtlas& map, const ParameterizeOptions& options, Progress& progress) {
  map.atlas.reassign_all();
  mend_charts(map.atlas);
  if (options.relaxations > 0) relax_or_descend(map.atlas, options, progress);
  lower_distortion_locally(map.atlas, kSweeps, progress);
  coarsen_map(map, progress);
}

/// The vertices that a level took out, put back into its map. Nothing where one has no place.
std::optional<EditableAtlas> put_back(const RemovalRecord& level, const EditableAtlas& map, Progress& progress,
                                      std::optional<Vec3>* unplaced) {
  const auto step = progress.step("put back vertices");
  std::optional<int> vertex;
  std::optional<EditableAtlas> more = reinsert(level, map, &vertex);
  if (vertex && unplaced) *unplaced = level.surface->mesh.positions[*vertex];
  return more;
}

/// A map that can still be changed, and how it was made.
struct EditableMap {
  EditableAtlas map;
  SmoothingRecord record;
};

std::optional<EditableMap> begin_coarsest(const SimplifyResult& simplified, const ParameterizeOptions& options,
                                          Progress& progress) {
  const auto step = progress.step("coarsest level");
  EditableAtlas map = simplified.map->coarsened();
  map.atlas.reassign_all();
  if (!settle_creases(map.atlas, progress)) return std::nullopt;
  const SmoothingRecord record = smooth_coarsest(map, options, simplified.finer.empty(), progress);
  return EditableMap{std::move(map), record};
}

}  // namespace

std::optional<SmoothedMap> smooth_coarsest_level(const SimplifyResult& simplified, const ParameterizeOptions& options,
                                                 Progress& progress) {
  std::optional<EditableMap> coarsest = begin_coarsest(simplified, options, progress);
  if (!coarsest) return std::nullopt;
  return SmoothedMap{std::move(coarsest->map.atlas), coarsest->record};
}

std::optional<SmoothedMap> smooth_levels(const SimplifyResult& simplified, const ParameterizeOptions& options,
                                         Progress& progress, std::optional<Vec3>* unplaced) {
  std::optional<EditableMap> coarsest = begin_coarsest(simplified, options, progress);
  if (!coarsest) return std::nullopt;
  EditableAtlas map = std::move(coarsest->map);
  for (auto level = simplified.finer.rbegin(); level != simplified.finer.rend(); ++level) {
    const auto finer = progress.step("finer levels");
    std::optional<EditableAtlas> more = put_back(*level, map, progress, unplaced);
    if (!more) return std::nullopt;
    map = std::move(*more);
    if (!settle_creases(map.atlas, progress)) return std::nullopt;
    smooth_finer(map, options, progress);
  }
  return SmoothedMap{std::move(map.atlas), coarsest->record};
}

}  // namespace gsp
