#pragma once

#include <cstdint>
#include <vector>

#include "coder/bitplane_coder.h"
#include "coder/displaced/scalar_forest.h"

namespace gsp {

struct ScalarLayout {
  int planes = 0;      ///< bits of the largest magnitude, 0..31
  int last_plane = 0;  ///< an encoder ends with it
  std::vector<std::uint8_t> place;  ///< #N class of the node's place on the control surface
};

using ScalarIntegers = BitplaneCoefficients::Component;

BitplaneParts encode_scalars(const ScalarForest& forest, const ScalarLayout& layout, const ScalarIntegers& integers,
                             Bytes& out, std::vector<std::size_t>* pass_ends = nullptr);
ScalarIntegers decode_scalars(const ScalarForest& forest, const ScalarLayout& layout, const std::uint8_t* begin,
                              const std::uint8_t* end);

}  // namespace gsp
