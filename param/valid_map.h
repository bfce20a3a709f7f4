#pragma once

#include <memory>
#include <vector>

#include "mesh/progress.h"
#include "param/atlas.h"
#include "param/shrinking_map.h"

namespace gsp {

/// A map onto the base complex in which every face has positive area and every vertex is wound rightly. Makes the removals
/// once more and takes out, at stations on the way, the folds that the straightening of edges has brought about since the
/// last one: few and shallow at a time, where in the end they would lie in each other's way. The stations move closer
/// together where that fails. Where a single removal cannot be unfolded its folds stay, so ask `find_folds`.
Atlas unfolded_map(std::shared_ptr<const Surface> surface, const std::vector<Removal>& removals, Progress& progress);

}  // namespace gsp
