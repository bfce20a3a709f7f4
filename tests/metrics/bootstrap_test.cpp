#include "metrics/bootstrap.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/error.h"
#include "mesh/random.h"

using namespace gsp;

namespace {

// Normal numbers by Box and Muller.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}
  double next() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random_.uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * random_.uniform());
  }

 private:
  Random random_;
};

// Groups with means about 0, and values about those.
std::vector<std::vector<double>> normal_groups(Normal& normal, int groups, int values, double between, double within) {
  std::vector<std::vector<double>> result(static_cast<std::size_t>(groups));
  for (std::vector<double>& group : result) {
    const double mean = between * normal.next();
    for (int i = 0; i < values; ++i) group.push_back(mean + within * normal.next());
  }
  return result;
}

// How often the interval holds the truth, 0.
double coverage(int groups, int values, double between, double within, bool fixed) {
  constexpr int kTrials = 2000;
  Normal normal(7);
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto data = normal_groups(normal, groups, values, between, within);
    held += bootstrap_mean(data, {.resamples = 400, .fixed_groups = fixed}).interval->holds(0.0);
  }
  return held / double(kTrials);
}

}  // namespace

TEST_CASE("Student's quantiles are those of the tables") {
  CHECK(student_quantile(0.975, 1.0) == Approx(12.7062).epsilon(1e-5));
  CHECK(student_quantile(0.975, 7.0) == Approx(2.36462).epsilon(1e-5));
  CHECK(student_quantile(0.025, 7.0) == Approx(-2.36462).epsilon(1e-5));
  CHECK(student_quantile(0.95, 1e6) == Approx(1.64485).epsilon(1e-5));
}

TEST_CASE("the variance of a sample is unbiased") {
  CHECK(sample_variance({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) == Approx(32.0 / 7.0));
  CHECK(sample_variance({3.0}) == 0.0);
}

TEST_CASE("of normal values the bootstrap's interval is Student's") {
  Normal normal(3);
  SECTION("one group") {
    const auto groups = normal_groups(normal, 1, 200, 0.0, 2.0);
    const MeanEstimate estimate = bootstrap_mean(groups);
    const double half = student_quantile(0.975, 199.0) * std::sqrt(sample_variance(groups[0]) / 200.0);
    CHECK(estimate.interval->low == Approx(estimate.mean - half).margin(0.04 * half));
    CHECK(estimate.interval->high == Approx(estimate.mean + half).margin(0.04 * half));
  }
  SECTION("a mean over groups, whose means are what scatters") {
    const auto groups = normal_groups(normal, 40, 8, 1.0, 0.5);
    std::vector<double> means;
    for (const auto& group : groups) {
      double sum = 0.0;
      for (double value : group) sum += value;
      means.push_back(sum / 8.0);
    }
    const MeanEstimate estimate = bootstrap_mean(groups, {.confidence = 0.9});
    const double half = student_quantile(0.95, 39.0) * std::sqrt(sample_variance(means) / 40.0);
    CHECK(estimate.interval->low == Approx(estimate.mean - half).margin(0.06 * half));
    CHECK(estimate.interval->high == Approx(estimate.mean + half).margin(0.06 * half));
  }
}

TEST_CASE("intervals hold the truth as often as they say") {
  // 2,000 trials have a standard error of 0.5%.
  CHECK(coverage(1, 8, 0.0, 1.0, false) == Approx(0.95).margin(0.015));
  CHECK(coverage(4, 8, 1.0, 0.5, false) == Approx(0.95).margin(0.02));
  CHECK(coverage(5, 8, 0.0, 1.0, false) == Approx(0.95).margin(0.02));
  CHECK(coverage(4, 8, 0.0, 1.0, true) == Approx(0.95).margin(0.015));
}

TEST_CASE("fixed groups leave their differences out of the interval") {
  const std::vector<std::vector<double>> groups = {{0.9, 1.0, 1.1}, {8.9, 9.0, 9.1}};
  const MeanEstimate of_all = bootstrap_mean(groups), of_these = bootstrap_mean(groups, {.fixed_groups = true});
  CHECK(of_all.mean == Approx(5.0));
  CHECK(of_these.mean == Approx(5.0));
  // Two means 8 apart: 12.7 times a standard error of 4. Two variances of 0.01/3 with four degrees of freedom: 2.78
  // times 0.0408.
  CHECK(of_all.interval->high - of_all.interval->low == Approx(2.0 * 12.7062 * 4.0).epsilon(0.05));
  CHECK(of_these.interval->high - of_these.interval->low == Approx(2.0 * 2.77645 * 0.0408248).epsilon(0.1));
}

TEST_CASE("without scatter to learn from there is no interval; equal values have one of no width") {
  CHECK_FALSE(bootstrap_mean({{2.5}}).interval);
  CHECK_FALSE(bootstrap_mean({{2.5}, {3.5}}, {.fixed_groups = true}).interval);
  CHECK(bootstrap_mean({{2.5}, {3.5}}).interval);
  CHECK(bootstrap_mean({{}, {2.5}}).mean == 2.5);
  const MeanEstimate equal = bootstrap_mean({{2.5, 2.5, 2.5}});
  REQUIRE(equal.interval);
  CHECK(equal.interval->low == 2.5);
  CHECK(equal.interval->high == 2.5);
}

TEST_CASE("the same seed gives the same interval, and what is no number is refused") {
  Normal normal(5);
  const std::vector<std::vector<double>> groups = normal_groups(normal, 6, 5, 1.0, 1.0);
  CHECK(bootstrap_mean(groups).interval->low == bootstrap_mean(groups).interval->low);
  CHECK(bootstrap_mean(groups).interval->low != bootstrap_mean(groups, {.seed = 2}).interval->low);
  CHECK_THROWS_AS(bootstrap_mean({{1.0, std::numeric_limits<double>::quiet_NaN()}}), Error);
  CHECK_THROWS_AS(bootstrap_mean({}), Error);
  CHECK_THROWS_AS(bootstrap_mean(groups, {.confidence = 1.0}), Error);
}
