#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace gsp {

// What contexts of the bit-plane coder are made of.

/// What is known of one component, by node.
struct Lane {
  std::uint32_t* magnitude;
  std::uint8_t* negative;
  std::uint8_t* low_plane;
  std::uint32_t* ring;           ///< sums of magnitudes beside each; at kNone a 0
  std::uint32_t* children;       ///< sums of the children's magnitudes
  std::uint8_t* tree_low_plane;  ///< at and above it, a closed tree is known to be empty
  const std::int8_t* urgency;
};

/// std::bit_width for x < 2^63, which needs no branch for 0.
inline int bit_width(std::uint64_t x) { return 63 - std::countl_zero(2 * x + 1); }

/// Octave of a magnitude < 2^60 in quarters of the plane's threshold: 0, 1, 2-3, 4-7, ...
inline int octave(std::uint64_t magnitude, int plane, int classes) {
  return std::min(bit_width(4 * magnitude >> plane), classes - 1);
}

/// Half octaves: 0, 1, 2, 3, 4-5, 6-7, 8-11, ...
inline int half_octave(std::uint64_t magnitude, int plane, int classes) {
  const std::uint64_t quarters = 4 * magnitude >> plane;
  const int width = bit_width(quarters);
  const int half_octaves = 2 * width - 4 + static_cast<int>(4 * quarters >> width);
  return quarters < 2 ? static_cast<int>(quarters) : std::min(half_octaves, classes - 1);
}

/// Index of a tuple of values into a table of the given extents, and the size of that table.
template <class... Rest>
constexpr int tuple_index(int value, int extent, Rest... rest) {
  if constexpr (sizeof...(rest) == 0)
    return value;
  else
    return value + extent * tuple_index(rest...);
}

}  // namespace gsp
