#pragma once

#include <optional>
#include <vector>

namespace gsp {

/// One size and what it buys.
struct RatePoint {
  double bytes = 0.0;
  double psnr_db = 0.0;
};

/// A rate-distortion curve: bytes strictly ascending, linear on log-bytes between its points, nothing outside them. Its
/// last point may be exact, of infinite PSNR: up to it the curve stays at the point before.
using RateCurve = std::vector<RatePoint>;

/// The points that no smaller or equally small point reaches, by ascending bytes: PSNR is strictly ascending too.
/// Points whose PSNR is no number and those without bytes are left out. O(n log n).
RateCurve upper_envelope(RateCurve points);

/// The envelope without the points that lie under the chord of two others at most `octaves` of bytes apart. Of an
/// envelope of samples of a smooth curve, it leaves out where the samples miss the curve, and keeps its large shape, be
/// that hollow or not.
RateCurve without_dips(RateCurve envelope, double octaves);

/// PSNR of an ascending curve at a size; empty outside its range.
std::optional<double> psnr_at(const RateCurve& curve, double bytes);

/// The least size at which the curve reaches a PSNR; empty where it never does or starts above it.
std::optional<double> bytes_at(const RateCurve& curve, double psnr_db);

/// The size from which on the curve is exact; empty where it never is.
std::optional<double> exact_from(const RateCurve& curve);

/// Its points of finite PSNR.
RateCurve finite_part(RateCurve curve);

/// Mean PSNR difference of two curves over a common range of sizes.
struct Gain {
  double mean_db = 0.0;     ///< mean over log-bytes of (ours - other)
  double from_bytes = 0.0;  ///< the range that both curves cover
  double to_bytes = 0.0;
};

/// Mean of ours - other over [from, to], cut to the sizes that the finite parts of both curves cover; exact for
/// piecewise linear curves. Empty where less than a tenth of an octave is common.
std::optional<Gain> mean_gain(const RateCurve& ours, const RateCurve& other, double from_bytes, double to_bytes);

}  // namespace gsp
