#include "metrics/sampled_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/parallel.h"
#include "metrics/area_sampler.h"
#include "metrics/quantile_histogram.h"
#include "metrics/sample_density.h"

namespace gsp {

namespace {

/// Samples that the quantile is taken from: its own error is then far below the width of a bin's share.
constexpr std::size_t kQuantileSamples = 1 << 20;
/// The pilot's random numbers are not those of the samples.
constexpr std::uint64_t kPilotSeed = 0x5851f42d4c957f2dULL;
/// Below this much of the diagonal a distance is rounding.
constexpr double kRmsRounding = 1e-14;

/// Sums over one block of strata. They are added in block order, so the total does not depend on the threads.
struct Partial {
  double weight = 0.0;
  double distance = 0.0;
  double squared = 0.0;
  double largest = 0.0;  ///< squared distance, without weight
  // Σ over pairs of neighbouring strata of the products of their differences in weight·d² (q) and in weight (w): the
  // variance of the ratio of sums is Σ (Δq - r·Δw)² once the ratio r is known.
  double qq = 0.0, qw = 0.0, ww = 0.0;

  void add(const Partial& p) {
    weight += p.weight;
    distance += p.distance;
    squared += p.squared;
    largest = std::max(largest, p.largest);
    qq += p.qq;
    qw += p.qw;
    ww += p.ww;
  }
};

Partial measure_block(const AreaSampler& sampler, const TriangleTree& target, std::size_t begin, std::size_t end,
                      QuantileHistogram& histogram) {
  std::array<Vec3, AreaSampler::kBlock> points;
  std::array<double, AreaSampler::kBlock> squared, weight;
  const std::size_t count = end - begin;
  sampler.sample(begin, end, points.data(), weight.data());
  squared_distances(target, points.data(), count, squared.data());
  const std::size_t stride = (sampler.samples() + kQuantileSamples - 1) / kQuantileSamples;
  for (std::size_t i = 0; i < count; i += stride) histogram.add(squared[i], weight[i]);
  Partial sum;
  for (std::size_t i = 0; i < count; ++i) {
    sum.weight += weight[i];
    sum.distance += weight[i] * std::sqrt(squared[i]);
    sum.squared += weight[i] * squared[i];
    sum.largest = std::max(sum.largest, squared[i]);
    // A last stratum without a partner is paired with its predecessor.
    if (i % 2 == 1 || (i + 1 == count && i > 0)) {
      const double dq = weight[i] * squared[i] - weight[i - 1] * squared[i - 1], dw = weight[i] - weight[i - 1];
      sum.qq += dq * dq;
      sum.qw += dq * dw;
      sum.ww += dw * dw;
    }
  }
  return sum;
}

OneWayDistance summarize(const Partial& total, const QuantileHistogram& histogram, std::size_t samples) {
  OneWayDistance result;
  result.samples = samples;
  result.mean = total.distance / total.weight;
  const double mean_square = total.squared / total.weight;
  result.rms = std::sqrt(mean_square);
  result.hausdorff = std::sqrt(total.largest);
  result.quantile95 = std::sqrt(std::min(histogram.quantile(0.95), total.largest));
  const double variance = total.qq - 2.0 * mean_square * total.qw + mean_square * mean_square * total.ww;
  // The root halves the relative error of the mean square.
  if (result.rms > 0.0)
    result.rms_standard_error = std::sqrt(std::max(0.0, variance)) / total.weight / (2.0 * result.rms);
  return result;
}

OneWayDistance measure(const AreaSampler& sampler, const TriangleTree& to, double diagonal, const std::string& stage,
                       Progress& progress) {
  const std::size_t samples = sampler.samples();
  const std::size_t blocks = (samples + AreaSampler::kBlock - 1) / AreaSampler::kBlock;
  std::vector<Partial> partials(blocks);
  QuantileHistogram histogram(diagonal * diagonal);
  // In a few rounds, so that progress is told and asked from this thread.
  const std::size_t round = std::max<std::size_t>(64, (blocks + 15) / 16);
  for (std::size_t first = 0; first < blocks; first += round) {
    parallel_for(std::min(round, blocks - first), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = first + begin; b < first + end; ++b)
        partials[b] = measure_block(sampler, to, b * AreaSampler::kBlock,
                                    std::min(samples, (b + 1) * AreaSampler::kBlock), histogram);
    });
    progress.report(stage, static_cast<double>(std::min(first + round, blocks)) / static_cast<double>(blocks));
  }
  Partial total;
  for (const Partial& p : partials) total.add(p);
  return summarize(total, histogram, samples);
}

}  // namespace

OneWayDistance sampled_distance(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to,
                                double diagonal, const DistanceOptions& options, const std::string& stage,
                                Progress& progress) {
  std::size_t samples = options.samples;
  while (true) {
    progress.report(stage, 0.0);
    const AreaSampler sampler(from, from_tree.order(), from_tree.areas(),
                              sample_density(from, from_tree, to, samples, options.seed ^ kPilotSeed), samples,
                              options.seed);
    const OneWayDistance result = measure(sampler, to, diagonal, stage, progress);
    const double error = result.standard_error_db();
    if (options.tolerance_db == 0.0 || error <= options.tolerance_db || samples >= options.most_samples ||
        result.rms <= kRmsRounding * diagonal)
      return result;
    // The error falls at least as fast as the root of the samples; a tenth more makes one further round likely to do.
    const double factor = std::clamp(1.1 * std::pow(error / options.tolerance_db, 2), 1.5, 100.0);
    samples = static_cast<std::size_t>(
        std::min(std::ceil(factor * static_cast<double>(samples)), static_cast<double>(options.most_samples)));
  }
}

}  // namespace gsp
