#pragma once

#include <string>
#include <vector>

#include "coder/anchors.h"
#include "experiments/curve/meter.h"

namespace gsp {

/// Draco on the input surface at 7 to 13 bits a coordinate, and without quantization: a row whose coder is
/// `kDracoLossless`.
std::vector<CurvePoint> draco_curve(const Meter& meter, std::size_t samples, Progress& progress);

/// What a practitioner does today: the surface and decimations of it to `decimation_sizes`, each coded by Draco at
/// those of 4 to 16 bits that may lie on the upper envelope; the points of that envelope, without those that sizes in
/// between would pass. 100,000 faces take about 12 CPU s.
std::vector<CurvePoint> decimate_draco_curve(const Meter& meter, Decimation decimation, std::size_t samples,
                                             Progress& progress);

/// Face counts, falling and different: `faces`, and from there three to an octave down to 20,000, six to an octave
/// down to 20. From 1 to 16 KB a curve of twice as many is 0.04 dB higher on the mean, 0.33 at most (bench/README.md,
/// "Anchors").
std::vector<int> decimation_sizes(int faces);

}  // namespace gsp
