#include "metrics/bd_rate.h"

#include <catch2/catch.hpp>

#include "mesh/error.h"
#include "metrics/cubic_interpolant.h"

using namespace gsp;

namespace {

constexpr BdInterpolation kAll[] = {BdInterpolation::Akima, BdInterpolation::Pchip, BdInterpolation::Cubic};

BdCurve curve(std::vector<BdPoint> points) { return {std::move(points)}; }

BdCurve sample_curve() {
  return curve({{500, 48.1}, {1000, 53.7}, {2100, 59.2}, {4000, 63.9}, {9000, 68.0}, {16000, 70.5}});
}

BdCurve scaled(BdCurve c, double factor, double offset_db) {
  for (BdPoint& p : c.points) p = {factor * p.rate, p.psnr_db + offset_db};
  return c;
}

BdResult compare(const BdCurve& a, const BdCurve& b, BdInterpolation kind = BdInterpolation::Pchip) {
  BdOptions options;
  options.interpolation = kind;
  return bd_compare(a, b, options);
}

}  // namespace

TEST_CASE("a curve at a constant factor of the rate has that BD-rate, by every interpolation") {
  for (BdInterpolation kind : kAll)
    for (double factor : {0.5, 0.9, 1.0, 1.25, 3.0}) {
      const BdResult r = compare(sample_curve(), scaled(sample_curve(), factor, 0.0), kind);
      CHECK(r.rate.value == Approx(100.0 * (factor - 1.0)).margin(1e-9));
      CHECK(r.rate.from == 48.1);
      CHECK(r.rate.to == 70.5);
      CHECK(r.rate.overlap_share == Approx(1.0));
      CHECK_FALSE(r.rate.small_overlap);
      CHECK(r.rate.warning.empty());
    }
}

TEST_CASE("a curve at a constant distance in PSNR has that BD-PSNR, by every interpolation") {
  for (BdInterpolation kind : kAll) {
    const BdResult r = compare(sample_curve(), scaled(sample_curve(), 1.0, 1.75), kind);
    CHECK(r.psnr.value == Approx(1.75));
    CHECK(r.psnr.from == Approx(500.0));
    CHECK(r.psnr.to == Approx(16000.0));
  }
}

TEST_CASE("straight curves have the mean of the difference of lines") {
  // psnr = 10 log10(rate) and 12 log10(rate) - 4 over [10, 1000]: 2 log10(rate) - 4 + ... averages 2*2 - 4 = 0.
  const BdCurve a = curve({{10, 10}, {31.6227766016838, 15}, {100, 20}, {1000, 30}});
  const BdCurve b = curve({{10, 8}, {31.6227766016838, 14}, {100, 20}, {1000, 32}});
  for (BdInterpolation kind : kAll) CHECK(compare(a, b, kind).psnr.value == Approx(0.0).margin(1e-9));
}

TEST_CASE("swapping the curves changes the sign, and the order of points does not matter") {
  const BdCurve a = sample_curve();
  const BdCurve b = curve({{16100, 71.9}, {600, 50.2}, {8000, 69.1}, {1200, 55.9}, {4100, 65.0}, {2000, 60.4}});
  for (BdInterpolation kind : kAll) {
    const BdResult ab = compare(a, b, kind), ba = compare(b, a, kind);
    CHECK(ab.psnr.value == Approx(-ba.psnr.value));
    CHECK((1.0 + ab.rate.value / 100.0) * (1.0 + ba.rate.value / 100.0) == Approx(1.0));
    CHECK(ab.rate.value < 0.0);
    CHECK(ab.psnr.value > 0.0);
  }
}

TEST_CASE("points that others beat are dropped and counted") {
  BdCurve a = sample_curve();
  a.points.push_back({5000, 60.0});
  a.points.push_back({4000, 63.9});
  const BdResult r = compare(a, sample_curve());
  CHECK(r.dropped_points == 2);
  CHECK(r.rate.value == Approx(0.0).margin(1e-9));
}

TEST_CASE("curves count up to their ceiling less the margin") {
  BdCurve a = sample_curve(), b = scaled(sample_curve(), 0.8, 0.0);
  b.ceiling_db = 70.0;
  const BdResult r = compare(a, b);
  CHECK(r.rate.to == Approx(60.0));
  CHECK(r.rate.value == Approx(-20.0));
  CHECK(r.psnr.to < 0.8 * 4000.0);
  CHECK(r.psnr.to > 0.8 * 2100.0);
  BdOptions none;
  none.ceiling_margin_db = 0.0;
  CHECK(bd_compare(a, b, none).rate.to == Approx(70.0));
}

TEST_CASE("a small overlap is warned of, and none is an error, never a number") {
  const BdCurve low = sample_curve(), high = scaled(sample_curve(), 10.0, 15.0);
  const BdResult r = compare(low, high);
  CHECK(r.rate.small_overlap);
  CHECK(r.rate.warning.find('%') != std::string::npos);
  CHECK(r.rate.overlap_share == Approx((70.5 - 63.1) / (85.5 - 48.1)));
  CHECK_THROWS_AS(compare(low, scaled(low, 10.0, 30.0)), Error);
  CHECK_THROWS_AS(compare(low, scaled(low, 1000.0, 0.0)), Error);
  BdCurve hopeless = low;
  hopeless.ceiling_db = 50.0;
  CHECK_THROWS_WITH(compare(low, hopeless), Catch::Contains("test curve starts") && Catch::Contains("of its ceiling"));
}

TEST_CASE("what is no curve is refused") {
  const BdCurve good = sample_curve();
  for (const BdPoint& bad :
       {BdPoint{0, 50}, BdPoint{-1, 50}, BdPoint{100, std::nan("")}, BdPoint{INFINITY, 50}, BdPoint{100, INFINITY}}) {
    BdCurve spoiled = good;
    spoiled.points.push_back(bad);
    CHECK_THROWS_AS(compare(good, spoiled), Error);
    CHECK_THROWS_AS(compare(spoiled, good), Error);
  }
  CHECK_THROWS_AS(compare(good, curve({})), Error);
  CHECK_THROWS_AS(compare(good, curve({{1000, 60}})), Error);
  CHECK_THROWS_AS(compare(good, curve({{1000, 60}, {2000, 62}, {3000, 64}}), BdInterpolation::Cubic), Error);
  CHECK(std::isfinite(compare(good, curve({{1000, 60}, {2000, 62}})).rate.value));
  BdCurve ceiling = good;
  ceiling.ceiling_db = std::nan("");
  CHECK_THROWS_AS(compare(good, ceiling), Error);
  CHECK_THROWS_AS(compare(curve({{1e-300, 1}, {2e-300, 2}}), curve({{1e300, 1}, {2e300, 2}})), Error);
}

TEST_CASE("interpolants pass through their knots, keep lines and cubics, and integrate what they evaluate") {
  const std::vector<double> x = {0, 1, 2.5, 4, 7}, y = {0, 2, 1, 5, 6};
  std::vector<double> line, cubic;
  for (double v : x) {
    line.push_back(3 * v - 1);
    cubic.push_back(v * v * v - 2 * v);
  }
  for (const auto& make : {&CubicInterpolant::akima, &CubicInterpolant::pchip}) {
    const CubicInterpolant f = make(x, y), g = make(x, line);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(f.value(x[i]) == Approx(y[i]).margin(1e-12));
    for (double v = 0; v <= 7; v += 0.35) CHECK(g.value(v) == Approx(3 * v - 1).margin(1e-12));
    double sum = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) sum += f.value(0.3 + (i + 0.5) * (6.1 - 0.3) / steps) * (6.1 - 0.3) / steps;
    CHECK(f.integral(0.3, 6.1) == Approx(sum).epsilon(1e-7));
  }
  const CubicInterpolant c = CubicInterpolant::least_squares(x, cubic);
  CHECK(c.value(3.0) == Approx(21.0));
  CHECK(c.integral(0.0, 7.0) == Approx(std::pow(7.0, 4) / 4 - 49.0));
}

TEST_CASE("slopes by hand: Akima's weights and PCHIP's harmonic mean") {
  // Secants 1, 1, 3, 3 around knot 2: Akima weighs both sides by |m3-m2| = 0 and |m1-m0| = 0, so takes their mean, 2;
  // PCHIP takes the harmonic mean, 1.5. Half way to the next knot the slopes there, 3, give (y + y)/2 + h/8 (s - s').
  const std::vector<double> x = {0, 1, 2, 3, 4}, y = {0, 1, 2, 5, 8};
  CHECK(CubicInterpolant::akima(x, y).value(2.5) == Approx(3.5 + (2.0 - 3.0) / 8.0));
  CHECK(CubicInterpolant::pchip(x, y).value(2.5) == Approx(3.5 + (1.5 - 3.0) / 8.0));
}
