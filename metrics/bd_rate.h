#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

/// One point of a rate-distortion curve.
struct BdPoint {
  double rate = 0.0;  ///< bytes, bits or bits per vertex, the same for both curves; positive
  double psnr_db = 0.0;
};

struct BdCurve {
  std::vector<BdPoint> points;  ///< in any order
  /// PSNR that the curve cannot pass, such as that of the uncoded remesh; infinite where there is none.
  double ceiling_db = std::numeric_limits<double>::infinity();
};

enum class BdInterpolation {
  Akima,  ///< Akima 1970; what JVET reports now
  Pchip,  ///< monotone cubic Hermite (Fritsch, Butland 1984), never overshoots
  Cubic,  ///< one cubic, by least squares where there are more than four points (Bjøntegaard, VCEG-M33): for old tables
};

const char* interpolation_name(BdInterpolation interpolation);

struct BdOptions {
  BdInterpolation interpolation = BdInterpolation::Pchip;
  double ceiling_margin_db = 10.0;  ///< curves count up to their ceiling less this, at least 0
};

/// One average over the range where both curves are known.
struct BdAverage {
  double value = 0.0;
  double from = 0.0, to = 0.0;  ///< the range: dB for BD-rate, rate for BD-PSNR
  double overlap_share = 0.0;   ///< of the range that either curve covers (dB or log rate); in (0, 1]
  bool small_overlap = false;   ///< share under kSmallOverlap: the average says little about the curves
  std::string warning;          ///< a sentence for people where the overlap is small, else empty
};

inline constexpr double kSmallOverlap = 0.5;

struct BdResult {
  BdAverage rate;  ///< per cent: mean rate of `test` over that of `anchor` at equal PSNR, less 100; negative is better
  BdAverage psnr;  ///< dB: mean PSNR of `test` less that of `anchor` at equal rate; positive is better
  int dropped_points = 0;  ///< of both curves: no better than one of at most their rate, so not on the curve
};

/// Bjøntegaard deltas (VCEG-M33) on the logarithm of the rate. Points that another one of the same curve beats at no
/// more rate are dropped. Every number of the result is finite. Throws Error(BadOption) where a point is not finite, a
/// rate not positive, a curve has fewer than 2 points left (4 for Cubic), or the curves do not overlap under their
/// ceilings.
BdResult bd_compare(const BdCurve& anchor, const BdCurve& test, const BdOptions& options);

}  // namespace gsp
