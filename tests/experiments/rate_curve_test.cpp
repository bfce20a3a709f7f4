#include "experiments/curve/rate_curve.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace gsp;

namespace {

// 5 dB per doubling, as curves of the field run, with a bend.
RateCurve sample_curve() {
  return {{256, 40.0}, {512, 45.0}, {1000, 51.0}, {4096, 60.0}, {30000, 66.0}, {100000, 67.0}};
}

RateCurve shifted(RateCurve curve, double bytes_factor, double db) {
  for (RatePoint& point : curve) point = {point.bytes * bytes_factor, point.psnr_db + db};
  return curve;
}

}  // namespace

TEST_CASE("the upper envelope keeps what no smaller point reaches") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const RateCurve envelope = upper_envelope(
      {{300, 50}, {100, 40}, {200, 39}, {300, 52}, {250, nan}, {400, 52}, {500, 53}, {600, infinite}, {0, 60}});
  REQUIRE(envelope.size() == 4);
  CHECK((envelope[0].bytes == 100 && envelope[0].psnr_db == 40));
  CHECK((envelope[1].bytes == 300 && envelope[1].psnr_db == 52));
  CHECK((envelope[2].bytes == 500 && envelope[2].psnr_db == 53));
  CHECK((envelope[3].bytes == 600 && envelope[3].psnr_db == infinite));
  CHECK(upper_envelope({}).empty());
}

TEST_CASE("dips go, the large shape stays") {
  // 300 lies under the chord of its neighbours, 0.3 octaves apart; with it gone, 280 lies over what is left.
  const RateCurve dip = {{270, 50.0}, {280, 50.6}, {300, 50.7}, {320, 52.0}};
  const RateCurve filled = without_dips(dip, 0.3);
  REQUIRE(filled.size() == 3);
  CHECK(filled[1].bytes == 280);
  // A long hollow is the curve itself.
  const RateCurve hollow = {{100, 40.0}, {200, 41.0}, {400, 44.0}, {800, 50.0}};
  CHECK(without_dips(hollow, 0.3).size() == 4);
  CHECK(without_dips(hollow, 2.0).size() < 4);
  CHECK(without_dips({}, 0.3).empty());
}

TEST_CASE("a curve is linear in log-bytes and says nothing outside its points") {
  const RateCurve curve = {{100, 40.0}, {400, 50.0}};
  CHECK(*psnr_at(curve, 100) == Approx(40.0));
  CHECK(*psnr_at(curve, 200) == Approx(45.0));
  CHECK(*psnr_at(curve, 400) == Approx(50.0));
  CHECK_FALSE(psnr_at(curve, 99));
  CHECK_FALSE(psnr_at(curve, 401));
  CHECK_FALSE(psnr_at({}, 100));
  CHECK(*bytes_at(curve, 45.0) == Approx(200));
  CHECK(*bytes_at(curve, 40.0) == Approx(100));
  CHECK_FALSE(bytes_at(curve, 39.9));
  CHECK_FALSE(bytes_at(curve, 50.1));
  for (double bytes : {300.0, 2000.0, 50000.0})
    CHECK(*bytes_at(sample_curve(), *psnr_at(sample_curve(), bytes)) == Approx(bytes));
}

TEST_CASE("the gain of a shifted curve is the shift") {
  const RateCurve curve = sample_curve();
  for (double shift : {-2.0, 0.0, 3.25}) {
    const auto gain = mean_gain(shifted(curve, 1.0, shift), curve, 1024, 50000);
    REQUIRE(gain);
    CHECK(gain->mean_db == Approx(shift).margin(1e-12));
    CHECK(gain->from_bytes == 1024);
    CHECK(gain->to_bytes == 50000);
  }
}

TEST_CASE("the gain does not depend on where either curve has its points") {
  // One line of 5 dB per octave, sampled differently, against the same line at half the bytes: 5 dB everywhere.
  RateCurve ours, other;
  for (double bytes = 150; bytes < 1e6; bytes *= 1.7) ours.push_back({bytes, 5.0 * std::log2(bytes) + 5.0});
  for (double bytes = 100; bytes < 1e6; bytes *= 3.1) other.push_back({bytes, 5.0 * std::log2(bytes)});
  CHECK(mean_gain(ours, other, 1024, 1e5)->mean_db == Approx(5.0).margin(1e-9));
  CHECK(mean_gain(other, ours, 1024, 1e5)->mean_db == Approx(-5.0).margin(1e-9));
}

TEST_CASE("curves are compared over the bytes that both cover only") {
  const RateCurve low = {{100, 30}, {1000, 45}}, high = {{500, 50}, {9000, 70}};
  const auto gain = mean_gain(high, low, 1, 1e9);
  REQUIRE(gain);
  CHECK(gain->from_bytes == 500);
  CHECK(gain->to_bytes == 1000);
  CHECK_FALSE(mean_gain(high, low, 999, 1e9));
  CHECK_FALSE(mean_gain(high, low, 5000, 1e9));
  CHECK_FALSE(mean_gain(high, {}, 1, 1e9));
  CHECK_FALSE(mean_gain(high, low, 600, 500));
}

TEST_CASE("an exact point ends a curve: its size is reached, and nothing is interpolated towards it") {
  const double exact = std::numeric_limits<double>::infinity();
  const RateCurve curve = upper_envelope({{2000, exact}, {1000, 50}, {500, 40}, {3000, exact}, {700, std::nan("")}});
  REQUIRE(curve.size() == 3);
  CHECK(*exact_from(curve) == 2000);
  CHECK(finite_part(curve).size() == 2);
  CHECK(*psnr_at(curve, 1000) == 50);
  CHECK(*psnr_at(curve, 1999) == 50);
  CHECK(*psnr_at(curve, 2000) == exact);
  CHECK(*bytes_at(curve, 45) == Approx(500 * std::sqrt(2.0)));
  CHECK(*bytes_at(curve, 60) == 2000);
  const RateCurve other = {{500, 35}, {2500, 35 + 5 * std::log2(5.0)}};
  const auto gain = mean_gain(curve, other, 0, 1e9);
  REQUIRE(gain);
  CHECK(gain->to_bytes == 1000);
  CHECK(gain->mean_db == Approx(7.5));
  const RateCurve only = {{100, exact}};
  CHECK(finite_part(only).empty());
  CHECK_FALSE(bytes_at(only, 70));  // it starts above: fewer bytes may do
  CHECK_FALSE(mean_gain(only, other, 0, 1e9));
  CHECK_FALSE(exact_from(other));
}
