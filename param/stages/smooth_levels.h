#pragma once

#include <optional>

#include "mesh/progress.h"
#include "param/simplify/simplify.h"
#include "param/stages/smoothed_map.h"

namespace gsp {

/// Smooths the map of a simplification from its coarsest level to the finest: the energy of distortion is lowered over
/// maps free of folds, and the corners are moved and base edges flipped in turn with it as the options say, at most
/// `options.relaxations` times on the coarsest level; on every finer one the corners are moved once. The energy knows
/// nothing of patches, so its minimiser is as smooth across their edges as within them. Vertices on feature curves are
/// held where `settle_creases` puts them on every level. Nothing where one level's map could not be followed by the
/// next for rounding, or a curve's vertices could not get to their places. `unplaced` then names the
/// place in space of the vertex that could not follow. Throws Error(Cancelled).
std::optional<SmoothedMap> smooth_levels(const SimplifyResult& simplified, const ParameterizeOptions& options,
                                         Progress& progress, std::optional<Vec3>* unplaced = nullptr);

/// The same of the coarsest level alone, whose surface is what the finer ones left.
std::optional<SmoothedMap> smooth_coarsest_level(const SimplifyResult& simplified, const ParameterizeOptions& options,
                                                 Progress& progress);

}  // namespace gsp
