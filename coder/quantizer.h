#pragma once

#include <vector>

#include "coder/bitplane_coder.h"
#include "coder/header.h"

namespace gsp {

/// Base positions have a bit more for each level; all must fit 31 bits, control points outside the box included.
constexpr int most_precision_bits(int level) { return 25 - level; }

/// L2 norm of the wavelet over that of the scaling function, in the limit and at equal spacing (algorithms.md §5).
double wavelet_norm(Wavelet wavelet);

/// Turns coefficients into integers. Steps are in inverse proportion to the L2 norm of what a coefficient adds to the
/// surface: the step of normal details doubles per finer level, tangential details take `header.tangential_ratio` times
/// it, base positions the coarsest level's share. Sets the header's step exponent, origin and plane counts.
/// `details[l]` are in local frames: normal, two tangential components. `precision_bits` is at most
/// `most_precision_bits`.
BitplaneCoefficients quantize(const std::vector<Vec3>& base, const std::vector<std::vector<Vec3>>& details,
                              double diagonal, int precision_bits, StreamHeader& header);

/// Where in its interval a magnitude is put, as a share of it: one of which the first bit is known, and others. Small
/// magnitudes are likelier inside each interval, most of all the lowest; yet details that are still zero, and the
/// chords of the finest triangles, leave the surface too flat, which larger values make up for. Found by measurement.
inline constexpr double kFirstCentroid = 0.47, kCentroid = 0.55;
/// That place, of a magnitude other than 0 whose bits are known from `low_plane` on, in steps.
inline double centroid(std::uint32_t magnitude, int low_plane) {
  const double share = magnitude >> low_plane == 1 ? kFirstCentroid : kCentroid;
  return magnitude + share * static_cast<double>(1u << low_plane);
}

/// The inverse, each value at the centre of what is known of it.
std::vector<Vec3> dequantize_base(const BitplaneCoefficients& integers, const StreamHeader& header);

/// Details of level `level` in local frames.
std::vector<Vec3> dequantize_details(const BitplaneCoefficients& integers, const EdgeForest& forest, int level,
                                     const StreamHeader& header);

}  // namespace gsp
