#pragma once

#include <array>
#include <vector>

#include "param/surface.h"

namespace gsp {

/// #E by edge: [0] of its end in the row of its start, [1] of its start in the row of its end.
using EdgeWeights = std::vector<std::array<double, 2>>;

/// Mean value weights (Floater 2003), w_ij = (tan(α/2) + tan(β/2)) / |p_i - p_j| with α, β the angles at i beside edge ij.
/// Lengths and half-angle tangents are bounded away from 0 and infinity so that degenerate faces leave the weights positive
/// and finite.
EdgeWeights mean_value_weights(const Surface& surface);

}  // namespace gsp
