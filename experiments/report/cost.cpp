#include "experiments/report/cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "experiments/plot/gnuplot.h"
#include "mesh/error.h"
#include "mesh/read_file.h"
#include "param/simplify/automatic_stop.h"

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

std::string cost_script(const std::string& name, const std::string& title, const CostCurve& cost) {
  std::string setup =
      "set logscale xy\nset key center left Left reverse\nset grid back lt 1 lw 1 lc rgb '#e4e4e4'\n"
      "set xlabel 'vertices that remain'\nset ylabel 'cost {/Symbol W} times vertices that remain'\n"
      "set format y '10^{%L}'\n";
  // The automatic stop is beyond the middle of the last bin.
  const double last = std::min(cost.bins.back().remaining, cost.third_stage.value_or(cost.bins.back().remaining));
  setup += fmt::format("set xrange [{:.6g}:{:.6g}]\nset title {} noenhanced\n", cost.bins.front().remaining, last,
                       gnuplot_quoted(title));
  std::vector<double> borders = {cost.bins.front().remaining};
  for (const std::optional<double>& at : {cost.second_stage, cost.third_stage}) {
    if (!at) continue;
    setup += fmt::format("set arrow from {0:.6g}, graph 0 to {0:.6g}, graph 1 nohead dt 2 lc rgb '#888888'\n", *at);
    borders.push_back(*at);
  }
  if (cost.third_stage)
    setup +=
        fmt::format("set label 'automatic stop: {0:.0f}' at {0:.6g}, graph 0.97 right offset -0.5,0 tc rgb '#888888'\n",
                    *cost.third_stage);
  if (last < borders.back()) borders.push_back(last);
  for (std::size_t stage = 1; stage < borders.size(); ++stage)
    setup += fmt::format("set label {0} '{0}' at {1:.6g}, graph 0.05 center font ',16' tc rgb '#888888'\n", stage,
                         std::sqrt(borders[stage - 1] * borders[stage]));
  setup += "$cost << EOD\n";
  for (const CostBin& bin : cost.bins)
    setup += fmt::format("{:.6g} {:.6g} {:.6g}\n", bin.remaining, bin.quality, bin.metric);
  setup += "EOD\n";
  const std::string commands =
      "plot $cost using 1:($2+$3) with lines lw 3 lc rgb '#c8102e' title 'cost', '' using 1:2 with lines lw 2 lc rgb "
      "'#1f5fa8' title 'triangle quality', '' using 1:3 with lines lw 2 lc rgb '#2b2b2b' title 'metric distortion'\n";
  return figure_script(name, setup, commands, 900, 560);
}

std::string cost_in_words(const CostCurve& cost) {
  return "1 mends ill-shaped triangles, 2 ascends slowly, 3 is ruled by metric distortion; " +
         (cost.third_stage ? fmt::format("metric distortion takes over at {:.0f} vertices", *cost.third_stage)
                           : "the base was reached before metric distortion took over");
}

std::vector<OmegaRecord> read_omega_csv(const std::string& path) {
  std::istringstream in(read_text(path));
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
