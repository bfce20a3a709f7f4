#pragma once

#include <vector>

#include "experiments/curve/meter.h"

namespace gsp {

/// Draco on the input surface at 7 to 13 bits a coordinate.
std::vector<CurvePoint> draco_curve(const Meter& meter, std::size_t samples, Progress& progress);

/// What a practitioner does today: quadric decimation to several sizes, each coded by Draco at 7 to 12 bits; of all
/// those the upper envelope. Chosen with few samples, then measured with `samples`.
std::vector<CurvePoint> decimate_draco_curve(const Meter& meter, std::size_t samples, Progress& progress);

/// Face counts to decimate to, descending: log-spaced, each about 3/4 of the one before, from half of `faces` to 64.
std::vector<int> decimation_sizes(int faces);

}  // namespace gsp
