#include "experiments/base/level_by_rate.h"

#include <catch2/catch.hpp>

#include "coder/codec.h"
#include "experiments/base/map_worth.h"
#include "mesh/shapes.h"
#include "metrics/surface_distance.h"
#include "param/parameterize.h"
#include "remesh/remesh.h"
#include "tests/by_threads.h"

using namespace gsp;

namespace {

Parameterization map_of(const Mesh& mesh, int base_vertices, int feature_degrees) {
  Progress progress;
  ParameterizeOptions options;
  options.base_vertices = base_vertices;
  options.feature_degrees = feature_degrees;
  return parameterize(mesh, options, progress).map;
}

SemiregularMesh by_rate(const Parameterization& map, const RemeshOptions& options = {}) {
  Progress progress;
  return remesh_by_rate(map, options, progress);
}

struct Rates {
  double mean_db = 0.0;  ///< of 1 to 16 KB
  double room_db = 0.0;  ///< between 16 KB and the remesh
};

Rates rates(const Parameterization& map, int level) {
  Progress progress;
  RemeshOptions remeshing;
  remeshing.level = level;
  const SemiregularMesh mesh = remesh(map, remeshing, progress);
  EncodeOptions coding;
  coding.wavelet = Wavelet::ButterflyLifted;
  const Bytes stream = encode(mesh, coding, progress);
  DistanceOptions sampling;
  sampling.samples = 50000;
  const auto psnr = [&](const Mesh& other) {
    return surface_distance(map.surface, other, sampling, progress).psnr_db();
  };
  Rates result;
  for (std::size_t bytes : kRatedBytes) {
    const double db = psnr(decode(stream, bytes).mesh());
    result.mean_db += db / 5.0;
    result.room_db = psnr(mesh.mesh()) - db;
  }
  return result;
}

}  // namespace

TEST_CASE("the level by rate is the finer one where the automatic one cuts off 16 KB", "[slow]") {
  // Maps that run across sharp rims, where the automatic level ends 0.3 dB over 16 KB and the next one codes 0.4 dB
  // better.
  for (const Parameterization& map :
       {map_of(shapes::cylinder(12), 8, kNoFeatures), map_of(shapes::lens(2), 6, kNoFeatures)}) {
    const int first = first_level_with(map.base.face_count(), 32768);
    const Rates coarse = rates(map, first), fine = rates(map, first + 1);
    REQUIRE(coarse.room_db < 1.0);
    REQUIRE(fine.room_db > 5.0);
    REQUIRE(fine.mean_db > coarse.mean_db + 0.2);
    CHECK(by_rate(map).level == first + 1);
  }
}

TEST_CASE("the level by rate is the automatic one where 16 KB are far from the remesh, the same for any threads",
          "[slow]") {
  const Parameterization map = map_of(shapes::bumpy_sphere(4), 250, kAutoFeatures);
  const auto [one, two] = by_one_and_two_threads([&] { return by_rate(map); });
  CHECK(one.positions == two.positions);
  const int first = first_level_with(map.base.face_count(), 32768);
  REQUIRE(rates(map, first).room_db > 4.2);
  CHECK(one.level == first);
}

TEST_CASE("levels that are given, and those of other kinds, are not chosen by rate", "[slow]") {
  const Parameterization map = map_of(shapes::box(2), 8, kNoFeatures);
  RemeshOptions options;
  options.level = 3;
  CHECK(by_rate(map, options).level == 3);
  options.level = RemeshOptions::kAutoLevel;
  options.kind = RemeshKind::Normal;
  CHECK(by_rate(map, options).level == first_level_with(map.base.face_count(), 32768));
}
