#pragma once

#include <cstdint>
#include <vector>

#include "coder/edge_forest.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Level whose faces' areas weigh the details of this level and all finer ones.
inline constexpr int kAreaLevel = 2;

/// How much earlier than on a mesh of equal triangles each node's bits are worth sending (bitplane_coder.h): an error
/// on the surface counts by its area, so steps should go with the inverse square root of the area that a detail spreads
/// over. `positions` are the decoder's own at level min(kAreaLevel, forest.levels()). O(N).
std::vector<std::int8_t> area_urgency(const std::vector<SubdivisionLevel>& levels, const EdgeForest& forest,
                                      const std::vector<Vec3>& positions);

}  // namespace gsp
