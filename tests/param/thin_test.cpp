#include <sys/resource.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>

#include "mesh/topology.h"
#include "param/atlas/split_edges.h"
#include "param/parameterize.h"
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
