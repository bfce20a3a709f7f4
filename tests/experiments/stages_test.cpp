#include "experiments/curve/stages.h"
#include "experiments/version.h"

#include <catch2/catch.hpp>

#include "mesh/shapes.h"

using namespace gsp;

namespace {

Progress silent;

CurveOptions small_run(std::vector<StreamMode> modes) {
  CurveOptions options;
  options.parameterize.base_vertices = 12;
  options.methods = {Method::Gsp};
  options.modes = std::move(modes);
  options.budgets = {128, 256, 512, 1024};
  options.samples = 20000;
  options.anchors = false;
  return options;
}

}  // namespace

TEST_CASE("streams for one size each keep to it, and decode to no less than the embedded stream's prefixes", "[slow]") {
  const SemiregularMesh mesh =
      remesh(parameterize(shapes::bumpy_sphere(4), {.base_vertices = 12}, silent).map, {}, silent);
  // What is held to be no worse is the distance to the remesh; near the ceiling that to the input may move either way.
  const Mesh reference = mesh.mesh();
  const Meter meter(reference, "remesh", 1);
  constexpr std::size_t kSamples = 20000;
  const std::vector<std::size_t> budgets = {128, 256, 512, 1024};
  const Bytes embedded = encode(mesh, {}, silent);
  const std::vector<CurvePoint> prefixes = decoded_curve(embedded, budgets, meter, kSamples, silent);
  const std::vector<CurvePoint> fixed =
      decoded_streams(fixed_streams(mesh, {}, embedded, budgets, silent), meter, kSamples, silent);
  CHECK(prefixes.front().version == version());
  REQUIRE(prefixes.size() == budgets.size() + 1);
  REQUIRE(fixed.size() == prefixes.size());
  double gain = 0.0;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    CAPTURE(prefixes[i].bytes, prefixes[i].psnr_db, fixed[i].psnr_db);
    CHECK(fixed[i].bytes <= prefixes[i].bytes);
    CHECK(fixed[i].faces == prefixes[i].faces);
    CHECK(fixed[i].psnr_db > prefixes[i].psnr_db - 0.02);
    gain += fixed[i].psnr_db - prefixes[i].psnr_db;
  }
  CHECK(gain > 0.1);
}

TEST_CASE("a mode's rows do not depend on what else is asked for", "[slow]") {
  const Mesh input = shapes::torus(24, 16);
  const auto both =
      rate_distortion_curve(input, "torus", small_run({StreamMode::Fixed, StreamMode::Embedded}), silent).points;
  const auto alone = rate_distortion_curve(input, "torus", small_run({StreamMode::Embedded}), silent).points;
  REQUIRE(both.size() == 2 * alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    CHECK(both[i].coder == "gsp-fixed");
    CHECK(both[alone.size() + i].coder == "gsp");
    CHECK(both[alone.size() + i].psnr_db == alone[i].psnr_db);
    CHECK(both[alone.size() + i].bytes == alone[i].bytes);
  }
}

TEST_CASE("prefixes measured by the order of the whole stream are as far as measured alone", "[slow]") {
  const Mesh input = shapes::bumpy_sphere(4);
  const SemiregularMesh mesh = remesh(parameterize(input, {.base_vertices = 12}, silent).map, {}, silent);
  const Bytes stream = encode(mesh, {}, silent);
  const Meter meter(input, "ball", 1);
  const std::vector<std::size_t> budgets = {200, 300, 1000};
  const std::vector<CurvePoint> rows = decoded_curve(stream, budgets, meter, 100000, silent);
  REQUIRE(rows.size() == budgets.size() + 1);
  for (const CurvePoint& row : rows) {
    const CurvePoint alone = meter.measure(decode(stream, row.bytes).mesh(), row.bytes, 100000, silent);
    CAPTURE(row.bytes);
    CHECK(row.faces == alone.faces);
    CHECK(row.psnr_db == Approx(alone.psnr_db).margin(4.0 * (row.standard_error_db + alone.standard_error_db)));
  }
}
