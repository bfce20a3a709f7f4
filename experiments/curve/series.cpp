#include "experiments/curve/series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "experiments/cells/cell_options.h"

namespace gsp {

std::string curve_name(const CurvePoint& point) {
  return point.method + (point.coder == coder_name(StreamMode::Fixed) ? " mode=fixed" : "");
}

void add_run(std::vector<CurveSeries>& curves, const std::string& name, int replicate, CurvePoints points) {
  if (points.empty()) return;
  auto curve = std::find_if(curves.begin(), curves.end(), [&](const CurveSeries& c) { return c.name == name; });
  if (curve == curves.end()) curve = curves.insert(curves.end(), CurveSeries{name, {}});
  CurvePoints& run = curve->runs[replicate];
  run.insert(run.end(), std::make_move_iterator(points.begin()), std::make_move_iterator(points.end()));
}

std::vector<CurveSeries> curves_of(const CurvePoints& points) {
  std::vector<CurveSeries> curves;
  for (const CurvePoint& point : points) add_run(curves, curve_name(point), point.replicate, {point});
  return curves;
}

RateCurve envelope_of(const CurvePoints& points) {
  RateCurve curve;
  for (const CurvePoint& point : points) curve.push_back({static_cast<double>(point.bytes), point.psnr_db});
  return upper_envelope(std::move(curve));
}

double ceiling_db(const CurvePoints& points) {
  return points.empty() || !(points.front().remesh_error > 0.0) ? 0.0 : -20.0 * std::log10(points.front().remesh_error);
}

double ceiling_db(const CurveSeries& series) {
  double sum = 0.0;
  for (const auto& [replicate, points] : series.runs) sum += ceiling_db(points);
  return series.runs.empty() ? 0.0 : sum / static_cast<double>(series.runs.size());
}

BdCurve bd_curve(const CurvePoints& points) {
  BdCurve curve;
  for (const RatePoint& point : envelope_of(points)) curve.points.push_back({point.bytes, point.psnr_db});
  if (const double ceiling = ceiling_db(points); ceiling > 0.0) curve.ceiling_db = ceiling;
  return curve;
}

std::vector<PairedRuns> paired_runs(const CurveSeries& first, const CurveSeries& second) {
  const bool once = first.runs.size() == 1 || second.runs.size() == 1;
  std::vector<PairedRuns> pairs;
  for (const auto& [replicate, points] : first.runs)
    for (const auto& [other, others] : second.runs)
      if (once || other == replicate) pairs.push_back({first.runs.size() > 1 ? replicate : other, &points, &others});
  return pairs;
}

std::vector<SpreadPoint> spread_of(const CurveSeries& series) {
  std::vector<RateCurve> curves;
  std::set<double> sizes;
  double from = 0.0, to = std::numeric_limits<double>::infinity();
  for (const auto& [replicate, points] : series.runs) {
    RateCurve curve = envelope_of(points);
    if (curve.empty()) continue;
    for (const RatePoint& point : curve) sizes.insert(point.bytes);
    from = std::max(from, curve.front().bytes);
    to = std::min(to, curve.back().bytes);
    curves.push_back(std::move(curve));
  }
  std::vector<SpreadPoint> spread;
  for (double bytes : sizes) {
    if (bytes < from || bytes > to) continue;
    SpreadPoint& point = spread.emplace_back(
        SpreadPoint{bytes, 0.0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
    for (const RateCurve& curve : curves) {
      const double psnr_db = *psnr_at(curve, bytes);
      point.mean_db += psnr_db / static_cast<double>(curves.size());
      point.lowest_db = std::min(point.lowest_db, psnr_db);
      point.highest_db = std::max(point.highest_db, psnr_db);
    }
  }
  return spread;
}

}  // namespace gsp
