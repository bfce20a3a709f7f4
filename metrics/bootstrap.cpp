#include "metrics/bootstrap.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "mesh/error.h"
#include "mesh/random.h"

namespace gsp {

namespace {

using Groups = std::vector<std::vector<double>>;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// The unbiased standard error of the mean of means, and its degrees of freedom; none where there is no scatter to learn
// it from.
struct StandardError {
  double value = 0.0;
  double degrees_of_freedom = 0.0;
};

StandardError standard_error(const Groups& groups, const std::vector<double>& means, bool fixed) {
  const double count = static_cast<double>(groups.size());
  if (!fixed) return {std::sqrt(sample_variance(means) / count), count - 1.0};
  // Of independent groups the variances add; the degrees of freedom are Welch's and Satterthwaite's.
  double sum = 0.0, squares = 0.0, least = 0.0;
  for (const std::vector<double>& values : groups) {
    const double free = static_cast<double>(values.size()) - 1.0;
    if (free < 1.0) return {};
    const double part = sample_variance(values) / static_cast<double>(values.size());
    sum += part;
    squares += part * part / free;
    least = least == 0.0 ? free : std::min(least, free);
  }
  return {std::sqrt(sum) / count, squares > 0.0 ? sum * sum / squares : least};
}

double resampled_mean(const std::vector<double>& values, Random& random) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += values[static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()))];
  return sum / static_cast<double>(values.size());
}

std::vector<double> resampled_means(const Groups& groups, bool fixed, const BootstrapOptions& options) {
  Random random(options.seed);
  std::vector<double> means(static_cast<std::size_t>(options.resamples));
  for (double& mean : means) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const std::size_t drawn =
          fixed ? i : static_cast<std::size_t>(random.uniform() * static_cast<double>(groups.size()));
      mean += resampled_mean(groups[drawn], random);
    }
    mean /= static_cast<double>(groups.size());
  }
  std::sort(means.begin(), means.end());
  return means;
}

double percentile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const double above = sorted[std::min(below + 1, sorted.size() - 1)];
  return sorted[below] + (at - std::floor(at)) * (above - sorted[below]);
}

void require_usable(const Groups& groups, const BootstrapOptions& options) {
  constexpr int kFewest = 100;
  if (groups.empty()) throw Error(Cause::BadOption, "there are no values to take a mean of");
  for (const std::vector<double>& values : groups)
    for (double value : values)
      if (!std::isfinite(value)) throw Error(Cause::BadOption, "a value to take a mean of is not finite");
  if (!(options.confidence > 0.0 && options.confidence < 1.0) || options.resamples < kFewest)
    throw Error(Cause::BadOption, "the bootstrap needs a confidence in (0, 1) and at least 100 resamples");
}

}  // namespace

double sample_variance(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const double mean = mean_of(values);
  double sum = 0.0;
  for (double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size() - 1);
}

double student_quantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
}

MeanEstimate bootstrap_mean(const Groups& all, const BootstrapOptions& options) {
  Groups groups;
  std::copy_if(all.begin(), all.end(), std::back_inserter(groups), [](const auto& values) { return !values.empty(); });
  require_usable(groups, options);
  std::vector<double> means;
  for (const std::vector<double>& values : groups) means.push_back(mean_of(values));
  MeanEstimate estimate{mean_of(means), std::nullopt};
  const bool fixed = options.fixed_groups || groups.size() == 1;
  const StandardError error = standard_error(groups, means, fixed);
  if (error.degrees_of_freedom < 1.0) return estimate;
  MeanInterval& interval = estimate.interval.emplace();
  interval = {estimate.mean, estimate.mean, estimate.mean};
  const std::vector<double> resampled = resampled_means(groups, fixed, options);
  const double upper = 0.5 + 0.5 * options.confidence;
  const double below = estimate.mean - percentile(resampled, 1.0 - upper);
  const double above = percentile(resampled, upper) - estimate.mean;
  const double share = below + above > 0.0 ? below / (below + above) : 0.5;
  const double width = 2.0 * error.value * student_quantile(upper, error.degrees_of_freedom);
  interval.low -= width * share;
  interval.high += width * (1.0 - share);
  return estimate;
}

}  // namespace gsp
