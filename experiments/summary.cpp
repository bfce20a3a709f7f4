#include "experiments/summary.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>

namespace gsp {

namespace {

double ceiling_db(const std::vector<CurvePoint>& points, const std::string& method) {
  for (const CurvePoint& point : points)
    if (point.method == method && point.remesh_error > 0.0) return -20.0 * std::log10(point.remesh_error);
  return 0.0;
}

// Where a curve comes within the margin of its ceiling: from there on it measures the remesh.
double trusted_bytes(const RateCurve& curve, double ceiling) {
  if (curve.empty()) return 0.0;
  if (ceiling == 0.0) return curve.back().bytes;
  if (curve.front().psnr_db > ceiling - kCeilingMarginDb) return 0.0;
  return bytes_at(curve, ceiling - kCeilingMarginDb).value_or(curve.back().bytes);
}

std::string cell(const std::optional<double>& value, int precision) {
  return value ? fmt::format("{:.{}f}", *value, precision) : "-";
}

void print_model(std::ostream& out, const CurveSummary& summary) {
  out << summary.model << '\n';
  if (!summary.failure.empty()) fmt::print(out, "  FAILED ({}): {}\n", summary.cause, summary.failure);
  if (summary.methods.empty()) return;
  fmt::print(out, "  {:<16}{:>6}{:>6}{:>9}", "method", "base", "level", "ceiling");
  for (double level : kTableLevelsDb) fmt::print(out, "{:>9}", fmt::format("{:.0f} dB", level));
  fmt::print(out, "{:>10}{:>20}{:>10}\n", "gain", "over bytes", "ratio");
  for (const MethodSummary& m : summary.methods) {
    const bool anchor = m.base_vertices == 0;
    fmt::print(out, "  {:<16}{:>6}{:>6}{:>9}", m.method, anchor ? "-" : std::to_string(m.base_vertices),
               anchor ? "-" : std::to_string(m.level), anchor ? "-" : fmt::format("{:.1f}", m.ceiling_db));
    for (const auto& bytes : m.bytes_at) fmt::print(out, "{:>9}", cell(bytes, 0));
    const std::string range = m.gain ? fmt::format("{:.0f}..{:.0f}", m.gain->from_bytes, m.gain->to_bytes) : "-";
    fmt::print(out, "{:>10}{:>20}{:>10}\n", m.gain ? fmt::format("{:+.2f} dB", m.gain->mean_db) : "-", range,
               m.bytes_ratio ? fmt::format("{:.2f}x", *m.bytes_ratio) : "-");
  }
}

}  // namespace

RateCurve method_curve(const std::vector<CurvePoint>& points, const std::string& method) {
  RateCurve curve;
  for (const CurvePoint& point : points)
    if (point.method == method) curve.push_back({static_cast<double>(point.bytes), point.psnr_db});
  return upper_envelope(curve);
}

std::vector<std::string> methods_of(const std::vector<CurvePoint>& points) {
  std::vector<std::string> methods;
  for (const CurvePoint& point : points)
    if (std::find(methods.begin(), methods.end(), point.method) == methods.end()) methods.push_back(point.method);
  return methods;
}

CurveSummary summarize(const std::string& model, const std::vector<CurvePoint>& points) {
  CurveSummary summary;
  summary.model = model;
  RateCurve first;
  double first_trusted = 0.0;
  for (const std::string& method : methods_of(points)) {
    const RateCurve curve = method_curve(points, method);
    MethodSummary& m = summary.methods.emplace_back();
    m.method = method;
    m.ceiling_db = ceiling_db(points, method);
    const auto row =
        std::find_if(points.begin(), points.end(), [&](const CurvePoint& p) { return p.method == method; });
    m.base_vertices = row->base_vertices;
    m.base_faces = row->base_faces;
    m.level = row->level;
    for (double level : kTableLevelsDb) m.bytes_at.push_back(bytes_at(curve, level));
    if (summary.methods.size() == 1) {
      first = curve;
      first_trusted = trusted_bytes(curve, m.ceiling_db);
      continue;
    }
    m.gain = mean_gain(first, curve, kCompareFromBytes, std::min(first_trusted, trusted_bytes(curve, m.ceiling_db)));
    const auto ours = bytes_at(first, kRatioLevelDb), theirs = bytes_at(curve, kRatioLevelDb);
    if (ours && theirs) m.bytes_ratio = *theirs / *ours;
  }
  return summary;
}

std::optional<double> mean_gain_db(const std::vector<CurveSummary>& summaries, const std::string& method, int& models) {
  double sum = 0.0;
  models = 0;
  for (const CurveSummary& summary : summaries)
    for (const MethodSummary& m : summary.methods)
      if (m.method == method && m.gain) {
        sum += m.gain->mean_db;
        ++models;
      }
  if (models == 0) return std::nullopt;
  return sum / models;
}

void print_summaries(std::ostream& out, const std::vector<CurveSummary>& summaries) {
  std::vector<std::string> others;
  std::string first;
  for (const CurveSummary& summary : summaries) {
    print_model(out, summary);
    for (const MethodSummary& m : summary.methods)
      if (std::find(others.begin(), others.end(), m.method) == others.end()) others.push_back(m.method);
    if (first.empty() && !summary.methods.empty()) first = summary.methods.front().method;
  }
  if (first.empty()) return;
  out << "mean over the models\n";
  for (const std::string& other : others) {
    int models = 0;
    if (const auto gain = mean_gain_db(summaries, other, models))
      fmt::print(out, "  {} over {}: {:+.2f} dB ({} of {} models)\n", first, other, *gain, models, summaries.size());
  }
  fmt::print(
      out,
      "PSNR = 20 log10(bounding-box diagonal of the input / RMS distance), RMS the larger of both directions.\n"
      "ceiling: PSNR of the uncoded remesh. 50 dB ...: bytes at which the curve reaches it.\n"
      "gain: PSNR of {} less that of the row's method, mean over log-bytes from {:.0f} bytes up to where the first\n"
      "of the two curves is within {:.0f} dB of its own ceiling. ratio: the row's bytes over those of {} at {:.0f} "
      "dB.\n"
      "Curves are linear in log-bytes between their points; decimate-draco is the upper envelope of its points.\n",
      first, kCompareFromBytes, kCeilingMarginDb, first, kRatioLevelDb);
}

}  // namespace gsp
