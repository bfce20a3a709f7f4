#include "experiments/curve/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

// The means of `all` over its members: of rates the geometric mean, of the ranges what all share.
BdResult mean_bd(const std::vector<BdResult>& all, double rate) {
  BdResult mean = all.front();
  mean.rate.value = rate;
  mean.psnr.value = 0.0;
  const auto narrow = [](BdAverage& average, const BdAverage& other) {
    average.from = std::max(average.from, other.from);
    average.to = std::min(average.to, other.to);
    average.overlap_share = std::min(average.overlap_share, other.overlap_share);
    average.small_overlap = average.small_overlap || other.small_overlap;
    if (average.warning.empty()) average.warning = other.warning;
  };
  for (const BdResult& bd : all) {
    mean.psnr.value += bd.psnr.value / static_cast<double>(all.size());
    narrow(mean.rate, bd.rate);
    narrow(mean.psnr, bd.psnr);
  }
  return mean;
}

void compare_bd(MethodSummary& m, const CurveSeries& first, const CurveSeries& series) {
  std::vector<BdResult> all;
  for (const auto& [replicate, ours, theirs] : paired_runs(first, series)) try {
      all.push_back(bd_compare(bd_curve(*theirs), bd_curve(*ours), {.ceiling_margin_db = kCeilingMarginDb}));
      m.log_rates.push_back(log_rate(all.back().rate.value));
    } catch (const Error& error) {
      m.no_bd = error.what();
    }
  if (all.empty()) return;
  const MeanEstimate rate = mean_percent({m.log_rates});
  m.bd = mean_bd(all, rate.mean);
  m.bd_interval = rate.interval;
}

void compare_gain(MethodSummary& m, const CurveSeries& first, const CurveSeries& series) {
  for (const auto& [replicate, ours, theirs] : paired_runs(first, series)) {
    const RateCurve our_curve = envelope_of(*ours), their_curve = envelope_of(*theirs);
    const auto gain = mean_gain(
        our_curve, their_curve, kCompareFromBytes,
        std::min(trusted_bytes(our_curve, ceiling_db(*ours)), trusted_bytes(their_curve, ceiling_db(*theirs))));
    if (!gain) continue;
    m.gains.push_back(gain->mean_db);
    if (!m.gain) m.gain = gain;
    m.gain->from_bytes = std::max(m.gain->from_bytes, gain->from_bytes);
    m.gain->to_bytes = std::min(m.gain->to_bytes, gain->to_bytes);
  }
  if (m.gains.empty()) return;
  const MeanEstimate mean = bootstrap_mean({m.gains});
  m.gain->mean_db = mean.mean;
  m.gain_interval = mean.interval;
}

// The geometric mean of the sizes at which the runs reach a PSNR, where all do; of one run the size to the last bit.
std::optional<double> mean_bytes_at(const CurveSeries& series, double psnr_db) {
  if (series.runs.size() == 1) return bytes_at(envelope_of(series.runs.begin()->second), psnr_db);
  double sum = 0.0;
  for (const auto& [replicate, points] : series.runs) {
    const auto bytes = bytes_at(envelope_of(points), psnr_db);
    if (!bytes) return std::nullopt;
    sum += std::log(*bytes);
  }
  return std::exp(sum / static_cast<double>(series.runs.size()));
}

ModelsMean models_mean(const std::vector<std::vector<double>>& groups,
                       MeanEstimate (*mean)(const std::vector<std::vector<double>>&, const BootstrapOptions&)) {
  const MeanEstimate estimate = mean(groups, {});
  ModelsMean result{estimate.mean, static_cast<int>(groups.size()), std::numeric_limits<int>::max(), {}, {}};
  for (const std::vector<double>& values : groups)
    result.replicates = std::min(result.replicates, static_cast<int>(values.size()));
  if (result.replicates == 1) return result;
  result.of_surfaces = estimate.interval;
  result.of_models = mean(groups, {.fixed_groups = true}).interval;
  return result;
}

}  // namespace

double log_rate(double percent) { return std::log1p(percent / 100.0); }

MeanEstimate mean_percent(const std::vector<std::vector<double>>& log_rates, const BootstrapOptions& options) {
  const auto percent = [](double log_rate) { return 100.0 * std::expm1(log_rate); };
  MeanEstimate mean = bootstrap_mean(log_rates, options);
  mean.mean = percent(mean.mean);
  if (mean.interval) mean.interval = {mean.mean, percent(mean.interval->low), percent(mean.interval->high)};
  return mean;
}

CurveSummary summarize(const std::string& model, const std::vector<CurveSeries>& curves) {
  CurveSummary summary;
  summary.model = model;
  for (const CurveSeries& series : curves) {
    const CurveSeries& first = curves.front();
    const CurvePoint& point = series.runs.begin()->second.front();
    MethodSummary& m = summary.methods.emplace_back();
    m.method = series.name;
    m.replicates = static_cast<int>(series.runs.size());
    m.ceiling_db = ceiling_db(series);
    m.exact_from_bytes = exact_from(series);
    m.base_vertices = point.base_vertices;
    m.base_faces = point.base_faces;
    m.level = point.level;
    m.positions = further_option(point.options, "positions");
    if (m.base_vertices > 0) m.coder = point.coder;
    for (const CurvePoint& row : series.runs.begin()->second)
      if (row.coder == kDracoLossless) m.lossless_bytes = row.bytes;
    for (double level : kTableLevelsDb) m.bytes_at.push_back(mean_bytes_at(series, level));
    if (summary.methods.size() == 1) continue;
    if (paired_runs(first, series).empty()) {
      m.no_bd = of_another_model(series.runs.begin()->second) ? kNoComparison : "no replicate in common";
      continue;
    }
    compare_gain(m, first, series);
    compare_bd(m, first, series);
    const auto ours = mean_bytes_at(first, kRatioLevelDb), theirs = mean_bytes_at(series, kRatioLevelDb);
    if (ours && theirs) m.bytes_ratio = *theirs / *ours;
  }
  return summary;
}

std::vector<std::string> compared_methods(const std::vector<CurveSummary>& summaries) {
  std::vector<std::string> methods;
  for (const CurveSummary& summary : summaries)
    for (std::size_t i = 1; i < summary.methods.size(); ++i)
      if (std::find(methods.begin(), methods.end(), summary.methods[i].method) == methods.end())
        methods.push_back(summary.methods[i].method);
  return methods;
}

MeanGain mean_gain_over(const std::vector<CurveSummary>& summaries, const std::string& method) {
  std::vector<std::vector<double>> gains, log_rates;
  for (const CurveSummary& summary : summaries)
    for (const MethodSummary& m : summary.methods) {
      if (m.method != method) continue;
      if (!m.gains.empty()) gains.push_back(m.gains);
      if (!m.log_rates.empty()) log_rates.push_back(m.log_rates);
    }
  MeanGain mean;
  if (!gains.empty()) mean.gain_db = models_mean(gains, bootstrap_mean);
  if (!log_rates.empty()) mean.bd_rate = models_mean(log_rates, mean_percent);
  return mean;
}

}  // namespace gsp
