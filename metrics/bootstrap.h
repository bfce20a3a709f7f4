#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gsp {

/// A mean, and the range that holds what it estimates with the confidence asked for.
struct MeanInterval {
  double mean = 0.0;
  double low = 0.0, high = 0.0;

  bool holds(double value) const { return low <= value && value <= high; }
};

struct BootstrapOptions {
  double confidence = 0.95;  ///< in (0, 1); 1 - 0.05/K where K intervals are to hold at once (Bonferroni)
  int resamples = 10000;     ///< at least 100
  std::uint64_t seed = 1;    ///< of the resamples: the same seed gives the same bits
  /// False: the groups are drawn from all there could be, as surfaces from all surfaces, and the interval is about
  /// those. True: it is about these groups, and only the values in them are drawn.
  bool fixed_groups = false;
};

/// Mean of the means of groups, such as surfaces, each with one value for each of its replicates, and its interval by
/// the bootstrap: groups are drawn with replacement, and values of each drawn group (Davison, Hinkley 1997,
/// section 3.8). Percentiles of resampled means alone lie too near to each other for few groups (Hesterberg 2015), so
/// they say how the interval lies about the mean, and its width is Student's: two quantiles of t by the unbiased
/// standard error. One group alone is taken as fixed. Empty groups are left out. The interval is empty where there is
/// no scatter to learn from: fewer than two values, or fixed groups of one value each. O(resamples · values). Throws
/// Error(BadOption) where a value is not finite or there is none.
struct MeanEstimate {
  double mean = 0.0;
  std::optional<MeanInterval> interval;
};
MeanEstimate bootstrap_mean(const std::vector<std::vector<double>>& groups, const BootstrapOptions& options = {});

/// The value that Student's t with so many degrees of freedom (positive) stays under with this probability, in (0, 1).
double student_quantile(double probability, double degrees_of_freedom);

/// Unbiased: the sum of squared deviations over n - 1; 0 for fewer than two values.
double sample_variance(const std::vector<double>& values);

}  // namespace gsp
