#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "coder/edge_forest.h"
#include "remesh/semiregular.h"

namespace gsp {

/// #N for each of normal, first and second tangential component.
using ComponentUrgency = std::array<std::vector<std::int8_t>, 3>;

/// How much earlier than a normal detail on a flat mesh of equal triangles each node's bits are worth sending
/// (bitplane_coder.h). To first order a displacement along the axis f moves the surface by ∫(n·f)² dA over its support:
/// so steps should go with the inverse square root of f's second moment of normals there. For tangential components
/// this is next to nothing where the surface is flat and smooth, and as much as for normal ones where it is neither;
/// they count for at least 1/`tangential_ratio`, since what is not known yet may bend the surface. `positions`
/// are the decoder's own of levels 0 to at most forest.levels(); nodes of the finest of these levels
/// and beyond take what their parents have. O(N).
ComponentUrgency surface_urgency(const std::vector<SubdivisionLevel>& levels, const EdgeForest& forest,
                                 const std::vector<std::vector<Vec3>>& positions, int tangential_ratio);

}  // namespace gsp
