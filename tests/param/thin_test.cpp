#include <sys/resource.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>

#include "mesh/error.h"
#include "mesh/topology.h"
#include "param/atlas/split_edges.h"
#include "param/parameterize.h"
#include "param/stages/valid_map.h"
#include "tests/support/thin_shapes.h"

using namespace gsp;

namespace {

constexpr double kMostAddedPerFace = 20.0, kMostSeconds = 10.0, kMostMegabytes = 500.0;

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Of this process so far: an upper bound for each of its maps.
double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

/// A closed cylinder whose ends are fans: the rim z = 0, the rim z = 1, then the middles of the ends.
Mesh fanned_cylinder(int sides) {
  Mesh mesh;
  for (double z : {0.0, 1.0})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::acos(-1.0) * i / sides;
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  mesh.positions.insert(mesh.positions.end(), {Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0)});
  for (int i = 0, n = sides; i < n; ++i) {
    const int j = (i + 1) % n;
    const Triangle around[] = {{i, j, n + j}, {i, n + j, n + i}, {2 * n, j, i}, {2 * n + 1, n + i, n + j}};
    mesh.faces.insert(mesh.faces.end(), std::begin(around), std::end(around));
  }
  return mesh;
}

}  // namespace

TEST_CASE("thin surfaces get a valid map in bounded time, memory and number of vertices", "[thin][slow]") {
  for (int exponent = 1; exponent <= 6; ++exponent)
    for (const thin_shapes::Shape& shape : thin_shapes::family(std::pow(10.0, exponent))) {
      INFO(shape.name << ", aspect 1e" << exponent);
      REQUIRE(topology_report(shape.mesh).usable());
      Progress progress;
      const double start = cpu_seconds();
      const ParameterizeResult result = parameterize(shape.mesh, {}, progress);
      CHECK(cpu_seconds() - start < kMostSeconds);
      CHECK(peak_megabytes() < kMostMegabytes);
      CHECK(check_map(result.map).valid());
      const Mesh& refined = result.map.surface;
      CHECK(refined.vertex_count() - shape.mesh.vertex_count() <= kMostAddedPerFace * shape.mesh.face_count());
      // The surface itself comes back, however it was pressed together for the map.
      for (int v = 0; v < shape.mesh.vertex_count(); ++v) REQUIRE(refined.positions[v] == shape.mesh.positions[v]);
      CHECK(surface_area(refined) == Approx(surface_area(shape.mesh)).epsilon(1e-6));
    }
}

TEST_CASE("splitting long edges keeps to the vertices it may add, and says how long edges were left", "[thin]") {
  for (double height : {1e-1, 1e-3, 1e-6}) {
    Mesh mesh = thin_shapes::triangle(height);
    const LongEdgeSplit split = split_long_edges(mesh, 1e-3 * height, 50);
    CHECK(split.added() <= 50);
    CHECK(mesh.vertex_count() == 3 + split.added());
    CHECK(split.longest > 1e-3 * height);
    CHECK(surface_area(mesh) == Approx(0.5 * height));
  }
  Mesh mesh = thin_shapes::triangle(1.0);
  CHECK(split_long_edges(mesh, 0.1, 0).added() == 0);
}

TEST_CASE("a refused map names the face of the input in which its first fault lies", "[thin]") {
  const Mesh input = thin_shapes::box(10.0, 1.0, 1.0);
  Progress progress;
  Parameterization map = parameterize(input, {}, progress).map;
  REQUIRE(map.surface.face_count() > input.face_count());
  REQUIRE_NOTHROW(require_valid(map, input));
  // A face on the side x = 0 is turned over. The input has two faces there.
  const auto at_side = [](const Mesh& mesh, int f) {
    const Triangle& t = mesh.faces[f];
    return std::all_of(t.begin(), t.end(), [&](int v) { return mesh.positions[v].x() == mesh.positions[t[0]].x(); });
  };
  int turned = 0;
  while (!at_side(map.surface, turned)) ++turned;
  const double side = map.surface.positions[map.surface.faces[turned][0]].x();
  std::swap(map.face_corners[turned][0], map.face_corners[turned][1]);
  try {
    require_valid(map, input);
    FAIL("a map with a fold was taken");
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::InvalidMap);
    REQUIRE(error.element() == Element::Face);
    const int named = static_cast<int>(*error.index());
    REQUIRE(named < input.face_count());
    CHECK(at_side(input, named));
    CHECK(input.positions[input.faces[named][0]].x() == side);
  }
}

TEST_CASE("a small surface whose levels cannot be joined is made in one level at once", "[thin][slow]") {
  int tries = 0;
  Progress progress;
  progress.on_note([&](const std::string& note) { tries += note.find("not be joined") != std::string::npos; });
  CHECK(check_map(parameterize(fanned_cylinder(1000), {}, progress).map).valid());
  CHECK(tries <= 1);
}

TEST_CASE("a flip that folds a face whose edges pass through its patches from beyond them is not made", "[thin]") {
  // Edges of the wall are as long as the cylinder: with 300 sides three faces were folded.
  ParameterizeOptions options;
  options.feature_degrees = kNoFeatures;
  options.base_vertices = 20;
  Progress progress;
  CHECK(check_map(parameterize(fanned_cylinder(300), options, progress).map).valid());
}
