#include "experiments/curve/series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "experiments/cells/cell_options.h"

namespace gsp {

std::string curve_name(const CurvePoint& point) {
  const std::string kind = further_option(point.options, "kind");
  const bool parametric = kind.empty() || kind == remesh_kind_name(RemeshKind::Parametric);
  return point.method + (parametric ? "" : " kind=" + kind) +
         (point.coder == coder_name(StreamMode::Fixed) ? " mode=fixed" : "");
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

bool on_a_curve(const CurvePoint& point) { return point.coder != kDracoLossless; }

bool of_another_model(const CurvePoints& points) {
  return std::any_of(points.begin(), points.end(),
                     [](const CurvePoint& point) { return point.coder.rfind(kAnotherModel, 0) == 0; });
}

RateCurve envelope_of(const CurvePoints& points) {
  RateCurve curve;
  for (const CurvePoint& point : points)
    if (on_a_curve(point)) curve.push_back({static_cast<double>(point.bytes), point.psnr_db});
  return upper_envelope(std::move(curve));
}

std::optional<double> ceiling_db(const CurvePoints& points) {
  if (points.empty()) return std::nullopt;
  const CurvePoint& any = points.front();
  if (any.remesh_error > 0.0) return -20.0 * std::log10(any.remesh_error);
  return any.base_vertices > 0 ? std::optional(std::numeric_limits<double>::infinity()) : std::nullopt;
}

std::optional<double> ceiling_db(const CurveSeries& series) {
  if (series.runs.empty()) return std::nullopt;
  double sum = 0.0;
  for (const auto& [replicate, points] : series.runs) {
    const auto ceiling = ceiling_db(points);
    if (!ceiling) return std::nullopt;
    sum += *ceiling;
  }
  return sum / static_cast<double>(series.runs.size());
}

std::optional<double> exact_from(const CurveSeries& series) {
  std::optional<double> last;
  for (const auto& [replicate, points] : series.runs) {
    const auto bytes = exact_from(envelope_of(points));
    if (!bytes) return std::nullopt;
    last = std::max(last.value_or(0.0), *bytes);
  }
  return last;
}

BdCurve bd_curve(const CurvePoints& points) {
  BdCurve curve;
  for (const RatePoint& point : finite_part(envelope_of(points))) curve.points.push_back({point.bytes, point.psnr_db});
  if (const auto ceiling = ceiling_db(points)) curve.ceiling_db = *ceiling;
  return curve;
}

std::vector<PairedRuns> paired_runs(const CurveSeries& first, const CurveSeries& second) {
  const bool once = first.runs.size() == 1 || second.runs.size() == 1;
  std::vector<PairedRuns> pairs;
  for (const auto& [replicate, points] : first.runs)
    for (const auto& [other, others] : second.runs)
      if ((once || other == replicate) && !of_another_model(points) && !of_another_model(others))
        pairs.push_back({first.runs.size() > 1 ? replicate : other, &points, &others});
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
    SpreadPoint point{bytes, 0.0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const RateCurve& curve : curves) {
      const double psnr_db = *psnr_at(curve, bytes);
      point.mean_db += psnr_db / static_cast<double>(curves.size());
      point.lowest_db = std::min(point.lowest_db, psnr_db);
      point.highest_db = std::max(point.highest_db, psnr_db);
    }
    if (std::isfinite(point.highest_db) || std::isinf(point.lowest_db)) spread.push_back(point);
  }
  return spread;
}

}  // namespace gsp
