#include "experiments/curve/summary.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <sstream>

using namespace gsp;

namespace {

// A method whose curve gains 5 dB per octave from 256 bytes on until it meets its ceiling.
void add_method(std::vector<CurvePoint>& points, const std::string& method, double db_at_256, double ceiling_db,
                int replicate = 0) {
  for (int octave = 0; octave <= 10; ++octave) {
    CurvePoint point;
    point.model = "model";
    point.method = method;
    point.replicate = replicate;
    point.bytes = std::size_t{256} << octave;
    point.psnr_db = std::min(db_at_256 + 5.0 * octave, ceiling_db > 0.0 ? ceiling_db : 1e9);
    point.remesh_error = ceiling_db > 0.0 ? std::pow(10.0, -ceiling_db / 20.0) : 0.0;
    point.base_vertices = ceiling_db > 0.0 ? 20 : 0;
    point.options = ceiling_db > 0.0 ? "weights=uniform positions=sampled" : "";
    points.push_back(point);
  }
}

}  // namespace

TEST_CASE("a summary gives back the gain, the range and the ratio that the curves were made with") {
  std::vector<CurvePoint> points;
  add_method(points, "gsp", 43.0, 80.0);
  add_method(points, "maps", 40.0, 80.0);
  add_method(points, "draco", 35.0, 0.0);
  const CurveSummary summary = summarize("model", curves_of(points));
  REQUIRE(summary.methods.size() == 3);
  const MethodSummary& gsp = summary.methods[0];
  CHECK(gsp.ceiling_db == Approx(80.0));
  CHECK(gsp.positions == "sampled");
  CHECK_FALSE(gsp.gain);
  // 65 dB: gsp needs (65-43)/5 octaves over 256 bytes.
  CHECK(*gsp.bytes_at[3] == Approx(256.0 * std::exp2(22.0 / 5.0)));

  const MethodSummary& maps = summary.methods[1];
  REQUIRE(maps.gain);
  CHECK(maps.gain->mean_db == Approx(3.0));
  // 3 dB at 5 dB an octave are 3/5 of an octave, from 43 dB up to 10 dB under both ceilings.
  REQUIRE(maps.bd);
  CHECK(maps.bd->rate.value == Approx(100.0 * (std::exp2(-3.0 / 5.0) - 1.0)));
  CHECK(maps.bd->rate.from == Approx(43.0));
  CHECK(maps.bd->rate.to == Approx(70.0));
  CHECK(maps.bd->psnr.value == Approx(3.0));
  CHECK(maps.gain->from_bytes == 1024.0);
  // gsp, the better one, is the first within 10 dB of its ceiling: at 70 dB.
  CHECK(maps.gain->to_bytes == Approx(256.0 * std::exp2(27.0 / 5.0)));
  CHECK(*maps.bytes_ratio == Approx(std::exp2(3.0 / 5.0)));

  const MethodSummary& draco = summary.methods[2];
  CHECK(draco.gain->mean_db == Approx(8.0));
  CHECK_FALSE(draco.ceiling_db);
  CHECK(draco.positions.empty());
}

TEST_CASE("points of another model have a curve, but no gain") {
  std::vector<CurvePoint> points;
  add_method(points, "gsp", 43.0, 80.0);
  add_method(points, "elsewhere", 40.0, 0.0);
  CHECK(summarize("model", curves_of(points)).methods[1].gain);
  for (CurvePoint& point : points)
    if (point.method == "elsewhere") point.coder = std::string(kAnotherModel) + "dinosaur";
  const MethodSummary elsewhere = summarize("model", curves_of(points)).methods[1];
  CHECK(elsewhere.bytes_at[3]);
  CHECK_FALSE(elsewhere.gain);
  CHECK_FALSE(elsewhere.bd);
  CHECK_FALSE(elsewhere.bytes_ratio);
  CHECK(elsewhere.no_bd == "its points are of another model");
}

TEST_CASE("streams made for one size alone are a curve of their own beside the embedded one of their method") {
  std::vector<CurvePoint> points, fixed;
  add_method(points, "gsp", 43.0, 80.0);
  add_method(fixed, "gsp", 43.5, 80.0);
  for (CurvePoint& point : fixed) point.coder = coder_name(StreamMode::Fixed);
  points.insert(points.end(), fixed.begin(), fixed.end());
  const CurveSummary summary = summarize("model", curves_of(points));
  REQUIRE(summary.methods.size() == 2);
  CHECK(summary.methods[0].method == "gsp");
  CHECK(summary.methods[1].method == "gsp mode=fixed");
  REQUIRE(summary.methods[1].gain);
  CHECK(summary.methods[1].gain->mean_db == Approx(-0.5));
  std::ostringstream out;
  print_summaries(out, {summary});
  CHECK(out.str().find("mode=fixed: ") != std::string::npos);
}

TEST_CASE("curves that lie in different ranges have no gain, and nothing is invented") {
  std::vector<CurvePoint> points;
  add_method(points, "gsp", 75.0, 80.0);  // within 10 dB of the ceiling from the first byte on
  add_method(points, "maps", 40.0, 80.0);
  const CurveSummary summary = summarize("model", curves_of(points));
  CHECK_FALSE(summary.methods[1].gain);
  CHECK_FALSE(summary.methods[1].bytes_ratio);
  CHECK_FALSE(summary.methods[1].bd);
  CHECK(summary.methods[1].no_bd.find("of its ceiling") != std::string::npos);
  CHECK_FALSE(mean_gain_over({summary}, "maps").gain_db);
  CHECK_FALSE(mean_gain_over({summary}, "maps").bd_rate);
}

TEST_CASE("the table names failures, means and the definition of its numbers") {
  std::vector<CurvePoint> points;
  add_method(points, "gsp", 43.0, 80.0);
  add_method(points, "maps-smoothed", 40.0, 80.0);
  CurveSummary failed;
  failed.model = "torn";
  failed.cause = "non-manifold-edge";
  failed.failure = "an edge has three faces (edge 7)";
  std::ostringstream out;
  print_summaries(out, {summarize("model", curves_of(points)), failed});
  const std::string text = out.str();
  for (const char* part :
       {"FAILED (non-manifold-edge): an edge has three faces (edge 7)", "+3.00 dB",
        "gsp over maps-smoothed: +3.00 dB (1 of 2 models, one run), BD-rate -34.0% (1 of 2 models, one run)",
        "PSNR = 20 log10", "ceiling:", "  sampled  "})
    CHECK(text.find(part) != std::string::npos);
}

TEST_CASE("an exact remesh has an infinite ceiling and an exact curve no BD-rate, both said") {
  CurvePoint point;
  point.model = "cube";
  point.method = "gsp";
  point.base_vertices = 8;
  point.bytes = 300;
  point.psnr_db = std::numeric_limits<double>::infinity();
  CurvePoint anchor = point;
  anchor.method = "draco";
  anchor.base_vertices = 0;
  anchor.bytes = 200;
  CurvePoint lower = point, lower_anchor = anchor;
  lower.bytes = lower_anchor.bytes = 100;
  lower.psnr_db = lower_anchor.psnr_db = 40.0;
  CHECK(std::isinf(*ceiling_db({point})));
  CHECK_FALSE(ceiling_db({anchor}));
  const CurveSummary summary = summarize("cube", curves_of({lower, point, lower_anchor, anchor}));
  REQUIRE(summary.methods.size() == 2);
  CHECK(*summary.methods[0].exact_from_bytes == 300);
  CHECK(*summary.methods[0].bytes_at.back() == 300);
  CHECK(*summary.methods[1].bytes_ratio == Approx(200.0 / 300.0));
  CHECK_FALSE(summary.methods[1].bd);
  CHECK_FALSE(summary.methods[1].no_bd.empty());
  std::ostringstream out;
  print_summaries(out, {summary});
  CHECK(out.str().find("exact from 300 bytes on") != std::string::npos);
  CHECK(out.str().find("inf") == out.str().find("infinite"));
}

TEST_CASE("replicates are paired, and their means have the intervals of what was put in") {
  // Chance moves both methods of a replicate together by far more than it moves their difference.
  const std::vector<double> chance = {0.0, 2.0, -1.5, 1.0}, gains = {3.0, 3.5, 2.5, 3.2};
  std::vector<CurvePoint> points;
  for (int r = 0; r < 4; ++r) {
    add_method(points, "gsp", 43.0 + chance[r], 90.0, r);
    add_method(points, "maps", 43.0 + chance[r] - gains[r], 90.0, r);
  }
  add_method(points, "draco", 35.0, 0.0);
  const CurveSummary summary = summarize("model", curves_of(points));
  REQUIRE(summary.methods.size() == 3);
  CHECK(summary.methods[0].replicates == 4);
  const MethodSummary& maps = summary.methods[1];
  REQUIRE(maps.gain_interval);
  CHECK(maps.gain->mean_db == Approx(3.05));
  // Student's t of three degrees of freedom on the standard error of the four gains.
  const double width = 2.0 * 3.18245 * std::sqrt(sample_variance(gains) / 4.0);
  CHECK(maps.gain_interval->high - maps.gain_interval->low == Approx(width));
  // 5 dB an octave: the mean of the logarithms is that of the gains.
  CHECK(maps.bd->rate.value == Approx(100.0 * (std::exp2(-3.05 / 5.0) - 1.0)));
  REQUIRE(maps.bd_interval);
  CHECK(std::log2((100.0 + maps.bd_interval->high) / (100.0 + maps.bd_interval->low)) == Approx(width / 5.0));

  // The anchor has one run, which goes with each of gsp's.
  const MethodSummary& draco = summary.methods[2];
  CHECK(draco.replicates == 1);
  CHECK(draco.gains.size() == 4);
  CHECK(draco.gain->mean_db == Approx(8.0 + 0.375));

  std::ostringstream out;
  print_summaries(out, {summary, summary});
  CHECK(out.str().find("(2 of 2 models, 4 replicates)") == std::string::npos);
  CHECK(out.str().find("on these models alone") != std::string::npos);
  CHECK(out.str().find("2 of 2 models, 4 replicates)") != std::string::npos);
}

TEST_CASE("means over models are those of the models, and their intervals about models or about chance") {
  std::vector<CurveSummary> summaries;
  const std::vector<double> by_model = {2.0, 4.0, 9.0};
  for (double gain : by_model) {
    std::vector<CurvePoint> points;
    for (int r = 0; r < 3; ++r) {
      add_method(points, "gsp", 50.0, 100.0, r);
      add_method(points, "maps", 50.0 - gain + 0.1 * (r - 1), 100.0, r);
    }
    summaries.push_back(summarize("model " + std::to_string(summaries.size()), curves_of(points)));
  }
  const MeanGain mean = mean_gain_over(summaries, "maps");
  REQUIRE(mean.gain_db);
  CHECK(mean.gain_db->value == Approx(5.0));
  CHECK(mean.gain_db->models == 3);
  CHECK(mean.gain_db->replicates == 3);
  const MeanInterval &surfaces = *mean.gain_db->of_surfaces, &here = *mean.gain_db->of_models;
  CHECK(surfaces.high - surfaces.low == Approx(2.0 * 4.30265 * std::sqrt(sample_variance(by_model) / 3.0)));
  // Each model's mean has the variance 0.01/3, theirs a ninth of the sum; six degrees of freedom.
  CHECK(here.high - here.low == Approx(2.0 * 2.44691 * std::sqrt(0.01 / 9.0)));
  CHECK(mean.bd_rate->value == Approx(100.0 * (std::exp2(-1.0) - 1.0)));
}

TEST_CASE("the spread of runs is their mean and extremes where all of them are known") {
  CurveSeries series{"gsp", {}};
  for (int r = 0; r < 2; ++r) {
    CurvePoints& points = series.runs[r];
    for (std::size_t bytes : {256, 1024, 4096}) {
      CurvePoint& point = points.emplace_back();
      point.bytes = bytes * (r == 0 ? 1 : 2);
      point.psnr_db = 40.0 + 5.0 * std::log2(bytes / 256.0);
    }
  }
  const std::vector<SpreadPoint> spread = spread_of(series);
  REQUIRE(spread.size() == 4);  // 512, 1024, 2048, 4096: the second run starts at 512, the first ends at 4096
  CHECK(spread[1].bytes == 1024.0);
  CHECK(spread[1].highest_db == Approx(50.0));
  CHECK(spread[1].lowest_db == Approx(45.0));
  CHECK(spread[1].mean_db == Approx(47.5));

  // A size that one run alone meets exactly has no mean; one that both do is exact.
  series.runs[0].back().psnr_db = std::numeric_limits<double>::infinity();
  CHECK(spread_of(series).back().bytes == 2048.0);
  CHECK_FALSE(exact_from(series));
  series.runs[1][1].psnr_db = 50.0;
  series.runs[1].back() = series.runs[0].back();
  CHECK(std::isinf(spread_of(series).back().mean_db));
  CHECK(*exact_from(series) == 4096.0);
}
