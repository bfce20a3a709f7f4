#pragma once

#include <algorithm>
#include <array>

namespace gsp {

/// The two ends of an edge as a key: the smaller first.
inline std::array<int, 2> ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace gsp
