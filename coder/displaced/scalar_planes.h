#pragma once

#include <vector>

#include "coder/bitplane_coder.h"
#include "coder/displaced/scalar_forest.h"

namespace gsp {

using ScalarIntegers = BitplaneCoefficients::Component;

/// Appends the embedded stream of the nodes' integers: plane by plane from `planes` - 1 (of at most 31) down, in each
/// first the nodes beside known ones, then the others and whether there is anything below them, then the next bit of
/// those known. O(nodes) for each plane.
BitplaneParts encode_scalars(const ScalarForest& forest, int planes, const ScalarIntegers& integers, Bytes& out);

/// What the bytes [begin, end) determine, up to the first that speaks of a level below the forest, as
/// `decode_bitplanes` has it; `stream_levels`: those of the forest that was coded. Any bytes are safe. Throws
/// Error(BadStream) where a check in the stream shows damage (coder/payload_check.h).
ScalarIntegers decode_scalars(const ScalarForest& forest, int stream_levels, int planes, const std::uint8_t* begin,
                              const std::uint8_t* end);

}  // namespace gsp
