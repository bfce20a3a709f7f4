#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "coder/base_connectivity.h"

namespace gsp {

/// A control point in steps of its grid from the origin.
using ControlSteps = std::array<std::uint32_t, 3>;

/// Bits of the largest coordinate, at most.
inline constexpr int kMostControlPlanes = 24;

/// Appends control points, #V of `base` in its order, each coordinate < 2^planes: every one is predicted from those
/// before it, by a third of the parallelograms over the edges opposite to it (Touma and Gotsman 1998) and two thirds of
/// its neighbours' mean, and what is left is coded with adaptive probabilities. O(V).
void encode_control(const CodedBase& base, int planes, const std::vector<ControlSteps>& points, Bytes& out);

/// The inverse. Throws Error(BadStream) where the bytes end early or lead out of range.
std::vector<ControlSteps> decode_control(const CodedBase& base, int planes, const std::uint8_t* begin,
                                         const std::uint8_t* end);

}  // namespace gsp
