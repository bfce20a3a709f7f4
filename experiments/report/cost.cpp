#include "experiments/report/cost.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "mesh/error.h"
#include "mesh/read_file.h"
#include "param/automatic_stop.h"

namespace gsp {

namespace {

constexpr int kBins = 64;

std::vector<CostBin> binned(const std::vector<OmegaRecord>& record) {
  struct Sum {
    double log_remaining = 0.0, quality = 0.0, metric = 0.0;
    int count = 0;
  };
  const auto log_of = [](const OmegaRecord& r) { return std::log(std::max(1, r.remaining_vertices)); };
  const double high = log_of(record.front()), low = log_of(record.back());
  std::vector<Sum> sums(kBins);
  for (const OmegaRecord& r : record) {
    const double share = high > low ? (high - log_of(r)) / (high - low) : 0.0;
    Sum& sum = sums[std::clamp(static_cast<int>(share * kBins), 0, kBins - 1)];
    sum.log_remaining += log_of(r);
    sum.quality += r.remaining_vertices * (r.shape + r.dispersion);
    sum.metric += r.remaining_vertices * r.metric;
    ++sum.count;
  }
  std::vector<CostBin> bins;
  for (const Sum& sum : sums)
    if (sum.count > 0)
      bins.push_back({std::exp(sum.log_remaining / sum.count), sum.quality / sum.count, sum.metric / sum.count});
  return bins;
}

/// Squared residual of the best line through points [begin, end).
double residual(const std::vector<double>& x, const std::vector<double>& y, std::size_t begin, std::size_t end) {
  const double n = static_cast<double>(end - begin);
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = begin; i < end; ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
    yy += (y[i] - my) * (y[i] - my);
  }
  return yy - (xx > 0.0 ? xy * xy / xx : 0.0);
}

std::optional<double> break_of(const std::vector<CostBin>& bins, double until) {
  constexpr std::size_t kFewest = 4;  // bins on either side
  std::vector<double> x, y;
  for (const CostBin& bin : bins)
    if (bin.remaining > until && bin.quality + bin.metric > 0.0) {
      x.push_back(-std::log(bin.remaining));
      y.push_back(std::log(bin.quality + bin.metric));
    }
  std::optional<double> best;
  double least = 0.0;
  for (std::size_t i = kFewest; i + kFewest <= x.size(); ++i) {
    const double sum = residual(x, y, 0, i) + residual(x, y, i, x.size());
    if (best && sum >= least) continue;
    least = sum;
    best = std::exp(-0.5 * (x[i - 1] + x[i]));
  }
  return best;
}

}  // namespace

CostCurve cost_curve(const std::vector<OmegaRecord>& record) {
  CostCurve curve;
  if (record.empty()) return curve;
  curve.bins = binned(record);
  AutomaticStop stop(record.front().remaining_vertices + 1);
  for (const OmegaRecord& r : record)
    if (stop.reached(r)) {
      curve.third_stage = r.remaining_vertices;
      break;
    }
  curve.second_stage = break_of(curve.bins, curve.third_stage.value_or(0.0));
  return curve;
}

std::vector<OmegaRecord> read_omega_csv(const std::string& path) {
  std::istringstream in(read_file(path));
  std::vector<OmegaRecord> record;
  std::string line;
  std::getline(in, line);
  for (long long number = 2; std::getline(in, line); ++number) {
    OmegaRecord r;
    if (std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &r.remaining_vertices, &r.shape, &r.dispersion, &r.metric) != 4 ||
        !std::isfinite(r.omega()))
      throw Error(Cause::Malformed, path + ": not a removal and its costs", Element::Line, number);
    record.push_back(r);
  }
  return record;
}

}  // namespace gsp
