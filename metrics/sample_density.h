#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "mesh/nearest/triangle_tree.h"

namespace gsp {

/// Where `samples` are worth more (Neyman's allocation): for each face of `from`, in the order of its tree, a density
/// that grows with the standard deviation of the squared distance to `to` around it. That is found by an eighth as many
/// samples (at most 2^19) and, where vertices are not more than half of the samples, at all of them: else a spike of a
/// few small faces would be found by chance or not at all, and the standard error would not know of it. The density is
/// 1 on average over area and never under kLeastDensity, so no sample stands for more than 1 / kLeastDensity of its
/// share. Empty, which means the same everywhere, where samples are too few or find no deviation. Deterministic.
std::vector<float> sample_density(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to,
                                  std::size_t samples, std::uint64_t seed);

inline constexpr float kLeastDensity = 0.25f;

}  // namespace gsp
