#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace gsp {

/// The two ends of an edge as a key: the smaller first.
inline std::array<int, 2> ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The same as one number, for tables. Vertices are >= 0.
inline std::uint64_t edge_key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

}  // namespace gsp
