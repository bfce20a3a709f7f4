#include "experiments/base/base_by_rate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "experiments/base/map_worth.h"
#include "mesh/shapes.h"
#include "param/creases/feature_budget.h"
#include "tests/by_threads.h"

using namespace gsp;

namespace {

BaseByRate choice(const Mesh& mesh) {
  Progress progress;
  return base_by_rate(mesh, {}, progress);
}

}  // namespace

TEST_CASE("the base by rate is the best of those that were tried or beside it, the same for one and two threads",
          "[slow]") {
  const Mesh mesh = shapes::bumpy_sphere(3);
  const auto [one, two] = by_one_and_two_threads([&] { return choice(mesh); });
  REQUIRE(!one.tried.empty());
  const auto best = std::max_element(one.tried.begin(), one.tried.end(),
                                     [](const BaseTried& a, const BaseTried& b) { return a.psnr_db < b.psnr_db; });
  const double octaves = std::log2(static_cast<double>(one.base_vertices) / best->asked);
  CHECK(std::abs(octaves) < 0.6);  // one step of the ladder
  CHECK(two.base_vertices == one.base_vertices);
  REQUIRE(two.tried.size() == one.tried.size());
  for (std::size_t i = 0; i < one.tried.size(); ++i) CHECK(two.tried[i].psnr_db == one.tried[i].psnr_db);
}

TEST_CASE("sizes that the simplification cannot reach are no choice, and a surface too small for any has none") {
  // Each of 16 spheres keeps four vertices, so no base has fewer than 64.
  Mesh spheres = shapes::sphere(1);
  for (int axis : {0, 1, 2, 0})
    spheres = shapes::twice(spheres, (axis == 0 ? 3.0 : 2.5) * spheres.face_count() / 80.0 * Vec3::Unit(axis));
  const BaseByRate chosen = choice(spheres);
  CHECK(chosen.base_vertices >= 60);
  for (const BaseTried& t : chosen.tried) {
    INFO(t.asked << " asked, " << t.base_vertices << " vertices");
    if (t.asked == chosen.base_vertices) CHECK(t.base_vertices <= 1.2 * t.asked);
  }
  CHECK(choice(shapes::sphere(1)).base_vertices == kBaseByOmega);  // 42 vertices

  Progress progress;
  ParameterizeOptions options;
  options.base_vertices = 33;
  CHECK(with_base_by_rate(spheres, options, progress).base_vertices == 33);
  options.base_vertices = kBaseByRate;
  CHECK(with_base_by_rate(spheres, options, progress).base_vertices == chosen.base_vertices);
}

TEST_CASE("a surface that cannot be parameterized is refused before a base is looked for") {
  Mesh broken = shapes::sphere(2);
  for (int k = 0; k < 2; ++k) {  // an edge of three and of four faces
    broken.positions.push_back({2.0 + k, 0.0, 0.0});
    broken.faces.push_back({broken.faces[0][0], broken.faces[0][1], broken.vertex_count() - 1});
  }
  Progress progress;
  CHECK_THROWS_AS(base_by_rate(broken, {}, progress), Error);
}

TEST_CASE("a base without room for all features grows where that is worth it", "[slow]") {
  // 8 corners, for which a base of 12 has no room, and one of 24 has; with them the box is met exactly.
  const Mesh box = shapes::box(3);
  Progress progress;
  ParameterizeOptions options;
  options.base_vertices = 12;
  REQUIRE(choose_features(box, options).given_way > 0);
  const ParameterizeOptions chosen = with_features_by_rate(box, options, progress);
  CHECK(chosen.base_vertices == 24);
  CHECK(chosen.feature_degrees == kAutoFeatures);
  options.base_vertices = 24;
  CHECK(with_features_by_rate(box, options, progress).base_vertices == 24);
}

TEST_CASE("a large surface gets the next base with room for all features, and no map is made to choose it", "[slow]") {
  const Mesh box = shapes::box(7);  // 196,608 faces
  Progress progress([](const std::string& stage, double) { return stage.find("base by rate") == std::string::npos; });
  ParameterizeOptions options;
  options.base_vertices = 12;
  CHECK(with_features_by_rate(box, options, progress).base_vertices == 24);
}

TEST_CASE("features that have no room are given up where a base without them is worth more", "[slow]") {
  const Mesh box = shapes::box(1);  // 26 vertices, so that no larger base is tried
  Progress progress;
  ParameterizeOptions options;
  options.base_vertices = 6;
  REQUIRE(choose_features(box, options).given_way > 0);
  const MapWorth worth(box, kRatedBytes, 32768);
  ParameterizeOptions none = options;
  none.feature_degrees = kNoFeatures;
  const auto with = worth.of(options, progress), without = worth.of(none, progress);
  REQUIRE(with);
  REQUIRE(without);
  REQUIRE(with->psnr_db != without->psnr_db);
  CHECK(with_features_by_rate(box, options, progress).feature_degrees ==
        (without->psnr_db > with->psnr_db ? kNoFeatures : kAutoFeatures));
  options.feature_degrees = 60;  // asked for
  CHECK(with_features_by_rate(box, options, progress).feature_degrees == 60);
}

TEST_CASE("a map is worth nothing where there is none, and little where a budget holds no more than a header") {
  Progress progress;
  ParameterizeOptions options;
  options.base_vertices = 3;
  const Mesh sphere = shapes::bumpy_sphere(3);
  CHECK_FALSE(MapWorth(sphere, {1024}, 1000).of(options, progress));
  options.base_vertices = 12;
  // 12 dB for each halving of the header's bytes.
  const auto at = [&](std::size_t bytes) { return MapWorth(sphere, {bytes}, 1000).of(options, progress)->psnr_db; };
  CHECK(at(4) == Approx(at(8) - 12.0));
  CHECK(at(8) < 6.0);
  CHECK(at(1024) > 30.0);
  CHECK(MapWorth(sphere, {8, 1024}, 1000).of(options, progress)->psnr_db == Approx(0.5 * (at(8) + at(1024))));
}

TEST_CASE("a surface with a vertex of hundreds of faces has no base by rate: that would take minutes") {
  constexpr int kSides = 600;  // of a cone with a flat bottom
  Mesh cone;
  for (int i = 0; i < kSides; ++i)
    cone.positions.push_back({std::cos(2.0 * M_PI * i / kSides), std::sin(2.0 * M_PI * i / kSides), 0.0});
  cone.positions.push_back({0.0, 0.0, 2.0});
  cone.positions.push_back({0.0, 0.0, 0.0});
  for (int i = 0; i < kSides; ++i) {
    const int next = (i + 1) % kSides;
    cone.faces.push_back({i, next, kSides});
    cone.faces.push_back({next, i, kSides + 1});
  }
  Progress silent;
  const BaseByRate choice = base_by_rate(cone, {}, silent);
  CHECK(choice.base_vertices == kBaseByOmega);
  CHECK(choice.tried.empty());
}
