#include "metrics/bd_rate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh/error.h"
#include "metrics/cubic_interpolant.h"

namespace gsp {

namespace {

/// A curve that rises strictly in both coordinates, the rate as its decimal logarithm.
struct Rising {
  std::vector<double> log_rate, psnr;
  double top = 0.0;  ///< PSNR up to which the curve counts
};

std::string text(const char* format, double a, double b) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

Rising rising(const BdCurve& curve, const BdOptions& options, const char* name, int& dropped) {
  if (std::isnan(curve.ceiling_db))
    throw Error(Cause::BadOption, std::string("the ceiling of the ") + name + " curve is no number");
  std::vector<BdPoint> points = curve.points;
  for (const BdPoint& p : points)
    if (!(p.rate > 0.0) || !std::isfinite(p.rate) || !std::isfinite(p.psnr_db))
      throw Error(Cause::BadOption,
                  std::string("the ") + name + " curve has a point without a positive rate or a finite PSNR");
  std::sort(points.begin(), points.end(), [](const BdPoint& a, const BdPoint& b) {
    return a.rate != b.rate ? a.rate < b.rate : a.psnr_db > b.psnr_db;
  });
  Rising result;
  for (const BdPoint& p : points) {
    const double log_rate = std::log10(p.rate);
    const bool beaten = !result.psnr.empty() && (p.psnr_db <= result.psnr.back() || log_rate <= result.log_rate.back());
    dropped += beaten;
    if (beaten) continue;
    result.log_rate.push_back(log_rate);
    result.psnr.push_back(p.psnr_db);
  }
  const std::size_t least = options.interpolation == BdInterpolation::Cubic ? 4 : 2;
  if (result.psnr.size() < least)
    throw Error(Cause::BadOption, std::string("the ") + name + " curve has " + std::to_string(result.psnr.size()) +
                                      " usable points; " + interpolation_name(options.interpolation) + " needs " +
                                      std::to_string(least));
  result.top = std::min(result.psnr.back(), curve.ceiling_db - options.ceiling_margin_db);
  if (!(result.top > result.psnr.front()))
    throw Error(Cause::BadOption, std::string("the ") + name +
                                      text(" curve starts at %.6g dB, within %.6g dB of its ceiling",
                                           result.psnr.front(), options.ceiling_margin_db));
  return result;
}

CubicInterpolant interpolant(BdInterpolation kind, const std::vector<double>& x, const std::vector<double>& y) {
  switch (kind) {
    case BdInterpolation::Akima:
      return CubicInterpolant::akima(x, y);
    case BdInterpolation::Pchip:
      return CubicInterpolant::pchip(x, y);
    case BdInterpolation::Cubic:
      break;
  }
  return CubicInterpolant::least_squares(x, y);
}

/// What curves are averaged over: its name, and a value of it as people read it.
struct Abscissa {
  const char* name;
  double (*shown)(double);
};
constexpr Abscissa kPsnr = {"PSNR", [](double x) { return x; }};
constexpr Abscissa kLogRate = {"rate", [](double x) { return std::pow(10.0, x); }};

/// Mean over the overlap of [low, high] ranges of test less anchor.
BdAverage average(const CubicInterpolant& anchor, double anchor_top, const CubicInterpolant& test, double test_top,
                  const Abscissa& over) {
  BdAverage result;
  result.from = std::max(anchor.front(), test.front());
  result.to = std::min(anchor_top, test_top);
  if (!(result.to > result.from))
    throw Error(Cause::BadOption, std::string("the curves do not overlap in ") + over.name + " under their ceilings: " +
                                      text("%.6g to %.6g", over.shown(anchor.front()), over.shown(anchor_top)) +
                                      " and " + text("%.6g to %.6g", over.shown(test.front()), over.shown(test_top)));
  const double length = result.to - result.from;
  result.overlap_share = length / (std::max(anchor_top, test_top) - std::min(anchor.front(), test.front()));
  result.value = (test.integral(result.from, result.to) - anchor.integral(result.from, result.to)) / length;
  result.small_overlap = result.overlap_share < kSmallOverlap;
  if (result.small_overlap)
    result.warning = std::string("the curves share ") +
                     text("%.0f%% of their range in ", 100.0 * result.overlap_share, 0.0) + over.name +
                     ": the average says little about the rest";
  return result;
}

void require_finite(const BdAverage& average) {
  if (!std::isfinite(average.value) || !std::isfinite(average.from) || !std::isfinite(average.to))
    throw Error(Cause::BadOption, "the curves are too far apart for their difference to be a number");
}

}  // namespace

const char* interpolation_name(BdInterpolation interpolation) {
  switch (interpolation) {
    case BdInterpolation::Akima:
      return "akima";
    case BdInterpolation::Pchip:
      return "pchip";
    case BdInterpolation::Cubic:
      break;
  }
  return "cubic";
}

BdResult bd_compare(const BdCurve& anchor_curve, const BdCurve& test_curve, const BdOptions& options) {
  if (!(options.ceiling_margin_db >= 0.0))
    throw Error(Cause::BadOption, "the margin under the ceiling is at least 0 dB");
  BdResult result;
  const Rising anchor = rising(anchor_curve, options, "anchor", result.dropped_points);
  const Rising test = rising(test_curve, options, "test", result.dropped_points);

  const CubicInterpolant anchor_rate = interpolant(options.interpolation, anchor.psnr, anchor.log_rate);
  const CubicInterpolant test_rate = interpolant(options.interpolation, test.psnr, test.log_rate);
  result.rate = average(anchor_rate, anchor.top, test_rate, test.top, kPsnr);
  result.rate.value = 100.0 * (std::pow(10.0, result.rate.value) - 1.0);
  require_finite(result.rate);

  // A curve counts up to the rate at which it reaches the top of its PSNR range.
  const auto top_rate = [](const Rising& curve, const CubicInterpolant& rate) {
    return curve.top >= curve.psnr.back() ? curve.log_rate.back()
                                          : std::min(rate.value(curve.top), curve.log_rate.back());
  };
  result.psnr =
      average(interpolant(options.interpolation, anchor.log_rate, anchor.psnr), top_rate(anchor, anchor_rate),
              interpolant(options.interpolation, test.log_rate, test.psnr), top_rate(test, test_rate), kLogRate);
  result.psnr.from = std::pow(10.0, result.psnr.from);
  result.psnr.to = std::pow(10.0, result.psnr.to);
  require_finite(result.psnr);
  return result;
}

}  // namespace gsp
