#include "experiments/curve/summary.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ostream>

#include "experiments/cells/cell_options.h"
#include "experiments/output/decibels.h"
#include "experiments/output/quoting.h"

namespace gsp {

namespace {

// Where a curve comes within the margin of its ceiling: from there on it measures the remesh.
double trusted_bytes(const RateCurve& curve, const std::optional<double>& ceiling) {
  if (curve.empty()) return 0.0;
  if (!ceiling) return curve.back().bytes;
  if (curve.front().psnr_db > *ceiling - kCeilingMarginDb) return 0.0;
  return bytes_at(curve, *ceiling - kCeilingMarginDb).value_or(curve.back().bytes);
}

std::string cell(const std::optional<double>& value, int precision) {
  return value ? fmt::format("{:.{}f}", *value, precision) : "-";
}

int name_width(const CurveSummary& summary) {
  std::size_t width = 14;
  for (const MethodSummary& m : summary.methods) width = std::max(width, m.method.size());
  return static_cast<int>(width) + 2;
}

void print_bd(std::ostream& out, const std::string& first, const MethodSummary& m) {
  if (!m.bd) {
    fmt::print(out, "  BD-rate of {} over {}: none, {}\n", first, m.method, m.no_bd);
    return;
  }
  const BdAverage &rate = m.bd->rate, &psnr = m.bd->psnr;
  fmt::print(out, "  BD-rate of {} over {}: {:+.1f}% ({:.1f}..{:.1f} dB, {:.0f}% shared), BD-PSNR {:+.2f} dB", first,
             m.method, rate.value, rate.from, rate.to, 100.0 * rate.overlap_share, psnr.value);
  fmt::print(out, " ({:.0f}..{:.0f} bytes, {:.0f}% shared)\n", psnr.from, psnr.to, 100.0 * psnr.overlap_share);
  for (const std::string& warning : {rate.warning, psnr.warning})
    if (!warning.empty()) fmt::print(out, "    warning: {}\n", warning);
}

void print_model(std::ostream& out, const CurveSummary& summary) {
  out << printable(summary.model) << '\n';
  if (!summary.failure.empty()) fmt::print(out, "  FAILED ({}): {}\n", summary.cause, printable(summary.failure));
  if (summary.methods.empty()) return;
  const int width = name_width(summary);
  fmt::print(out, "  {:<{}}{:>6}{:>6}{:>11}{:>9}", "method", width, "base", "level", "positions", "ceiling");
  for (double level : kTableLevelsDb) fmt::print(out, "{:>9}", fmt::format("{:.0f} dB", level));
  fmt::print(out, "{:>10}{:>20}{:>10}\n", "gain", "over bytes", "ratio");
  for (const MethodSummary& m : summary.methods) {
    const bool anchor = m.base_vertices == 0;
    fmt::print(out, "  {:<{}}{:>6}{:>6}{:>11}{:>9}", m.method, width, anchor ? "-" : std::to_string(m.base_vertices),
               anchor ? "-" : std::to_string(m.level), m.positions.empty() ? "-" : m.positions,
               m.ceiling_db ? db_text(*m.ceiling_db, 1) : "-");
    for (const auto& bytes : m.bytes_at) fmt::print(out, "{:>9}", cell(bytes, 0));
    const std::string range = m.gain ? fmt::format("{:.0f}..{:.0f}", m.gain->from_bytes, m.gain->to_bytes) : "-";
    fmt::print(out, "{:>10}{:>20}{:>10}\n", m.gain ? fmt::format("{:+.2f} dB", m.gain->mean_db) : "-", range,
               m.bytes_ratio ? fmt::format("{:.2f}x", *m.bytes_ratio) : "-");
  }
  for (const MethodSummary& m : summary.methods)
    if (m.exact_from_bytes) fmt::print(out, "  {} is exact from {:.0f} bytes on\n", m.method, *m.exact_from_bytes);
  for (std::size_t i = 1; i < summary.methods.size(); ++i)
    print_bd(out, summary.methods.front().method, summary.methods[i]);
  for (const MethodSummary& m : summary.methods)
    if (m.lossless_bytes)
      fmt::print(out, "  {} codes the input without loss in {} bytes, from where on no other connectivity can win\n",
                 m.method, *m.lossless_bytes);
}

void print_definitions(std::ostream& out, const std::string& first, bool fixed) {
  fmt::print(
      out,
      "PSNR = 20 log10(bounding-box diagonal of the input / RMS distance), RMS the larger of both directions.\n"
      "A surface that is met exactly has an infinite PSNR, which is written as exact and in no mean.\n"
      "positions: what the remesh's vertices are; the paper's are sampled. ceiling: PSNR of the uncoded remesh.\n"
      "50 dB ...: bytes at which the curve reaches it; - where it starts above, or does not.\n"
      "gain: PSNR of {} less that of the row's method, mean over log-bytes from {:.0f} bytes up to where the first\n"
      "of the two curves is within {:.0f} dB of its own ceiling. ratio: the row's bytes over those of {} at {:.0f} "
      "dB. Neither is said where the curves have nothing of it in common.\n"
      "Curves are linear in log-bytes between their points. decimate-draco: decimated by quadrics, then Draco; "
      "lindstrom-turk-draco:\n"
      "by the collapses that keep the volume, then Draco. Without loss: coordinates in single precision.\n"
      "BD-rate, BD-PSNR: mean bytes of {} at equal PSNR less the other's, and mean PSNR at equal bytes, by PCHIP on "
      "the\n"
      "logarithm of bytes, where both curves are known and under their ceilings less {:.0f} dB; shared: of the range "
      "that\n"
      "either covers.\n",
      first, kCompareFromBytes, kCeilingMarginDb, first, kRatioLevelDb, first, kCeilingMarginDb);
  if (fixed)
    fmt::print(
        out,
        "mode=fixed: a stream for each size alone (gsp encode --mode fixed); the other curves are prefixes of one "
        "stream.\n");
}

void compare_bd(MethodSummary& m, const std::vector<CurvePoint>& first, const std::vector<CurvePoint>& points) {
  try {
    m.bd = bd_compare(bd_curve(points), bd_curve(first), {.ceiling_margin_db = kCeilingMarginDb});
  } catch (const Error& error) {
    m.no_bd = error.what();
  }
}

}  // namespace

std::optional<double> ceiling_db(const std::vector<CurvePoint>& points) {
  if (points.empty()) return std::nullopt;
  const CurvePoint& any = points.front();
  if (any.remesh_error > 0.0) return -20.0 * std::log10(any.remesh_error);
  return any.base_vertices > 0 ? std::optional(std::numeric_limits<double>::infinity()) : std::nullopt;
}

bool on_a_curve(const CurvePoint& point) { return point.coder != kDracoLossless; }

RateCurve envelope_of(const std::vector<CurvePoint>& points) {
  RateCurve curve;
  for (const CurvePoint& point : points)
    if (on_a_curve(point)) curve.push_back({static_cast<double>(point.bytes), point.psnr_db});
  return upper_envelope(std::move(curve));
}

BdCurve bd_curve(const std::vector<CurvePoint>& points) {
  BdCurve curve;
  for (const RatePoint& point : finite_part(envelope_of(points))) curve.points.push_back({point.bytes, point.psnr_db});
  if (const auto ceiling = ceiling_db(points)) curve.ceiling_db = *ceiling;
  return curve;
}

std::string curve_name(const CurvePoint& point) {
  return point.method + (point.coder == coder_name(StreamMode::Fixed) ? " mode=fixed" : "");
}

std::vector<CurveSeries> curves_of(const std::vector<CurvePoint>& points) {
  std::vector<CurveSeries> curves;
  for (const CurvePoint& point : points) {
    const std::string name = curve_name(point);
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const CurveSeries& c) { return c.name == name; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), CurveSeries{name, {}});
    curve->points.push_back(point);
  }
  return curves;
}

CurveSummary summarize(const std::string& model, const std::vector<CurveSeries>& curves) {
  CurveSummary summary;
  summary.model = model;
  RateCurve first;
  double first_trusted = 0.0;
  for (const auto& [name, points] : curves) {
    if (points.empty()) continue;
    const RateCurve curve = envelope_of(points);
    MethodSummary& m = summary.methods.emplace_back();
    m.method = name;
    m.ceiling_db = ceiling_db(points);
    m.exact_from_bytes = exact_from(curve);
    m.base_vertices = points.front().base_vertices;
    m.base_faces = points.front().base_faces;
    m.level = points.front().level;
    m.positions = further_option(points.front().options, "positions");
    if (m.base_vertices > 0) m.coder = points.front().coder;
    for (const CurvePoint& point : points)
      if (point.coder == kDracoLossless) m.lossless_bytes = point.bytes;
    for (double level : kTableLevelsDb) m.bytes_at.push_back(bytes_at(curve, level));
    if (summary.methods.size() == 1) {
      first = curve;
      first_trusted = trusted_bytes(curve, m.ceiling_db);
      continue;
    }
    m.gain = mean_gain(first, curve, kCompareFromBytes, std::min(first_trusted, trusted_bytes(curve, m.ceiling_db)));
    compare_bd(m, curves.front().points, points);
    const auto ours = bytes_at(first, kRatioLevelDb), theirs = bytes_at(curve, kRatioLevelDb);
    if (ours && theirs) m.bytes_ratio = *theirs / *ours;
  }
  return summary;
}

MeanGain mean_gain_over(const std::vector<CurveSummary>& summaries, const std::string& method) {
  MeanGain mean;
  double gain = 0.0, bd_rate = 0.0;
  for (const CurveSummary& summary : summaries)
    for (const MethodSummary& m : summary.methods) {
      if (m.method != method) continue;
      if (m.gain) gain += m.gain->mean_db, ++mean.gain_models;
      if (m.bd) bd_rate += m.bd->rate.value, ++mean.bd_models;
    }
  if (mean.gain_models > 0) mean.gain_db = gain / mean.gain_models;
  if (mean.bd_models > 0) mean.bd_rate = bd_rate / mean.bd_models;
  return mean;
}

void print_summaries(std::ostream& out, const std::vector<CurveSummary>& summaries) {
  std::vector<std::string> others;
  std::string first;
  bool fixed = false;
  for (const CurveSummary& summary : summaries) {
    print_model(out, summary);
    for (const MethodSummary& m : summary.methods) {
      if (std::find(others.begin(), others.end(), m.method) == others.end()) others.push_back(m.method);
      fixed = fixed || m.coder == coder_name(StreamMode::Fixed);
    }
    if (first.empty() && !summary.methods.empty()) first = summary.methods.front().method;
  }
  if (first.empty()) return;
  bool any = false;
  for (const std::string& other : others) {
    const MeanGain mean = mean_gain_over(summaries, other);
    if (!mean.gain_db && !mean.bd_rate) continue;
    if (!any) out << "mean over the models\n";
    any = true;
    fmt::print(out, "  {} over {}:", first, other);
    if (mean.gain_db)
      fmt::print(out, " {:+.2f} dB ({} of {} models)", *mean.gain_db, mean.gain_models, summaries.size());
    if (mean.bd_rate)
      fmt::print(out, "{} BD-rate {:+.1f}% ({} of {} models)", mean.gain_db ? "," : "", *mean.bd_rate, mean.bd_models,
                 summaries.size());
    out << '\n';
  }
  print_definitions(out, first, fixed);
}

}  // namespace gsp
