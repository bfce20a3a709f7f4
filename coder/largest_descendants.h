#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "coder/bitplane_coder.h"

namespace gsp {

/// #N: of each component, the largest magnitude below a node. O(N).
inline std::vector<std::array<std::uint32_t, 3>> largest_descendants(const EdgeForest& forest,
                                                                     const BitplaneCoefficients& coefficients) {
  std::vector<std::array<std::uint32_t, 3>> largest(forest.nodes(), {0, 0, 0});
  for (int n = forest.nodes() - 1; n >= 0; --n) {
    const int parent = forest.parent[n];
    if (parent < 0) continue;
    for (int c = 0; c < 3; ++c)
      largest[parent][c] = std::max({largest[parent][c], largest[n][c], coefficients.details[c].magnitude[n]});
  }
  return largest;
}

}  // namespace gsp
