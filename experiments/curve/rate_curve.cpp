#include "experiments/curve/rate_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gsp {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double interpolate(double x, double x0, double y0, double x1, double y1) {
  return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
}

}  // namespace

RateCurve upper_envelope(RateCurve points) {
  std::erase_if(points, [](const RatePoint& p) { return !(p.psnr_db > -kInfinity) || !(p.bytes > 0.0); });
  std::sort(points.begin(), points.end(), [](const RatePoint& a, const RatePoint& b) {
    return a.bytes != b.bytes ? a.bytes < b.bytes : a.psnr_db > b.psnr_db;
  });
  RateCurve envelope;
  for (const RatePoint& point : points)
    if (envelope.empty() || point.psnr_db > envelope.back().psnr_db) envelope.push_back(point);
  return envelope;
}

RateCurve without_dips(RateCurve envelope, double octaves) {
  for (std::size_t i = 1; i + 1 < envelope.size();) {
    const RatePoint &left = envelope[i - 1], &middle = envelope[i], &right = envelope[i + 1];
    const bool near = std::log2(right.bytes / left.bytes) <= octaves;
    if (near && middle.psnr_db < interpolate(std::log(middle.bytes), std::log(left.bytes), left.psnr_db,
                                             std::log(right.bytes), right.psnr_db)) {
      envelope.erase(envelope.begin() + static_cast<std::ptrdiff_t>(i));
      i = std::max<std::size_t>(i - 1, 1);  // what was dropped may have held up the one before
    } else {
      ++i;
    }
  }
  return envelope;
}

std::optional<double> psnr_at(const RateCurve& curve, double bytes) {
  if (curve.empty() || bytes < curve.front().bytes || bytes > curve.back().bytes) return std::nullopt;
  const auto right = std::lower_bound(curve.begin(), curve.end(), bytes,
                                      [](const RatePoint& point, double value) { return point.bytes < value; });
  if (right->bytes == bytes) return right->psnr_db;
  const auto left = right - 1;
  if (right->psnr_db == kInfinity) return left->psnr_db;
  return interpolate(std::log(bytes), std::log(left->bytes), left->psnr_db, std::log(right->bytes), right->psnr_db);
}

std::optional<double> bytes_at(const RateCurve& curve, double psnr_db) {
  if (curve.empty() || psnr_db < curve.front().psnr_db) return std::nullopt;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].psnr_db < psnr_db) continue;
    if (i == 0 || curve[i].psnr_db == kInfinity) return curve[i].bytes;
    return std::exp(interpolate(psnr_db, curve[i - 1].psnr_db, std::log(curve[i - 1].bytes), curve[i].psnr_db,
                                std::log(curve[i].bytes)));
  }
  return std::nullopt;
}

std::optional<double> exact_from(const RateCurve& curve) {
  return !curve.empty() && curve.back().psnr_db == kInfinity ? std::optional(curve.back().bytes) : std::nullopt;
}

RateCurve finite_part(RateCurve curve) {
  if (exact_from(curve)) curve.pop_back();
  return curve;
}

std::optional<Gain> mean_gain(const RateCurve& our_curve, const RateCurve& other_curve, double from_bytes,
                              double to_bytes) {
  const RateCurve ours = finite_part(our_curve), other = finite_part(other_curve);
  if (ours.empty() || other.empty()) return std::nullopt;
  const double from = std::max({from_bytes, ours.front().bytes, other.front().bytes});
  const double to = std::min({to_bytes, ours.back().bytes, other.back().bytes});
  if (!(std::log2(to / from) > 0.1)) return std::nullopt;

  // The difference is linear between neighbouring knots of either curve, so the trapezoid rule is exact.
  std::vector<double> knots = {from, to};
  for (const RateCurve* curve : {&ours, &other})
    for (const RatePoint& point : *curve)
      if (point.bytes > from && point.bytes < to) knots.push_back(point.bytes);
  std::sort(knots.begin(), knots.end());
  double integral = 0.0;
  double previous = *psnr_at(ours, from) - *psnr_at(other, from);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double difference = *psnr_at(ours, knots[i]) - *psnr_at(other, knots[i]);
    integral += 0.5 * (previous + difference) * std::log(knots[i] / knots[i - 1]);
    previous = difference;
  }
  return Gain{integral / std::log(to / from), from, to};
}

}  // namespace gsp
