#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "coder/edge_forest.h"
#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

using Bytes = std::vector<std::uint8_t>;

/// Integers of one mesh, as far as they are known: all bits from the top down to the lowest plane known, zeros below.
struct BitplaneCoefficients {
  /// #B base vertices, offsets from the origin in base steps, and the lowest plane known of each.
  std::vector<std::array<std::uint32_t, 3>> base;
  std::vector<std::array<std::uint8_t, 3>> base_low_plane;
  /// One of normal, first and second tangential component: #N magnitudes in steps, signs, lowest planes known.
  struct Component {
    std::vector<std::uint32_t> magnitude;
    std::vector<std::uint8_t> negative;
    std::vector<std::uint8_t> low_plane;
  };
  std::array<Component, 3> details;
};

/// Fractions of a bit-plane in which bits are ordered.
inline constexpr int kPassesPerPlane = 4;
/// Offsets of a node's bits against the order of planes.
inline constexpr int kMaxUrgency = 2 * kPassesPerPlane, kMinUrgency = -6 * kPassesPerPlane;

/// For each component in 1/kPassesPerPlane of a plane: how much earlier than others a node's bits are worth sending,
/// kMinUrgency..kMaxUrgency.
using NodeUrgency = std::function<std::array<std::int8_t, 3>(int node)>;
/// A function of what is known so far, which both sides ask for at the same places of the stream.
using Urgency = std::function<NodeUrgency(const BitplaneCoefficients& known)>;

/// What encoder and decoder must agree on besides the forest.
struct BitplaneLayout {
  int base_planes = 0;                            ///< bits of a base coordinate, 0..31
  int detail_planes = 0;                          ///< bits of the largest detail magnitude, 0..31
  int levels = 0;                                 ///< detail levels of the stream; the forest may end earlier
  bool scalar = false;                            ///< nodes have tangential components on boundaries and creases only
  std::vector<std::vector<int>> base_neighbours;  ///< #B, adjacent base vertices
  Urgency urgency;
  /// The last pass that an encoder writes, at least kMaxUrgency, with which every node's last plane ends. A stream that
  /// ends before is a prefix of the one that does not: its decoder need not know.
  int last_pass = kMaxUrgency;
};

/// Bits of the stream by what they say.
struct BitplaneParts {
  double base = 0.0;
  double checks = 0.0;
  struct Component {
    double trees = 0.0, significance = 0.0, signs = 0.0, refinement = 0.0;
  };
  std::array<Component, 3> details;
};

/// Appends the embedded stream to `out`: bits in the order of their plane and their node's urgency; in each pass the
/// base positions first, then level by level the details and whether there are any below. A node's bits end at plane
/// (kMaxUrgency - urgency) / kPassesPerPlane, so that all end at the same importance. O(nodes) for each plane.
BitplaneParts encode_bitplanes(const EdgeForest& forest, const BitplaneLayout& layout,
                               const BitplaneCoefficients& coefficients, Bytes& out);

/// Where an embedded stream stands, as its encoder sees it.
struct BitplaneState {
  BitplaneCoefficients known;
  /// #N for each component: bits by which news would have cost more than none, sign included, in the last decision on
  /// whether the node is significant; kNoPrice where none was coded.
  std::array<std::vector<float>, 3> news_price;
  static constexpr float kNoPrice = -1e9f;
};

/// The state after the first `bytes` of what encode_bitplanes writes, or after all where they are fewer.
BitplaneState encode_bitplanes_until(const EdgeForest& forest, const BitplaneLayout& layout,
                                     const BitplaneCoefficients& coefficients, std::size_t bytes);

/// What the bytes [begin, end) determine, up to the first that speaks of a level below the forest. Of the node in whose
/// decision they end the plane counts as known and 0, which is part of the format. Any bytes are safe. Throws
/// Error(BadStream) where a check in the stream shows damage (coder/payload_check.h).
BitplaneCoefficients decode_bitplanes(const EdgeForest& forest, const BitplaneLayout& layout, const std::uint8_t* begin,
                                      const std::uint8_t* end);

}  // namespace gsp
