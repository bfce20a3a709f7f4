#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "metrics/triangle_tree.h"

namespace gsp {

/// Where samples are worth more (Neyman's allocation): for each face of `from`, in the order of its tree, a density that
/// grows with the standard deviation of the squared distance to `to` around it, found by `pilot` samples. The density is
/// 1 on average over area and never under kLeastDensity, so no sample stands for more than 1 / kLeastDensity of its share.
/// Empty, which means the same everywhere, where the pilot is too small or finds no deviation. Deterministic.
std::vector<float> sample_density(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to, std::size_t pilot,
                                  std::uint64_t seed);

inline constexpr float kLeastDensity = 0.25f;

}  // namespace gsp
