#include "experiments/curve/summary.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

using namespace gsp;

namespace {

// A method whose curve gains 5 dB per octave from 256 bytes on until it meets its ceiling.
void add_method(std::vector<CurvePoint>& points, const std::string& method, double db_at_256, double ceiling_db) {
  for (int octave = 0; octave <= 10; ++octave) {
    CurvePoint point;
    point.model = "model";
    point.method = method;
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
  for (const char* part : {"FAILED (non-manifold-edge): an edge has three faces (edge 7)", "+3.00 dB",
                           "gsp over maps-smoothed: +3.00 dB (1 of 2 models), BD-rate -34.0% (1 of 2 models)",
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
