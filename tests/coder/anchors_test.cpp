#include "coder/anchors.h"

#include <catch2/catch.hpp>

#include "mesh/error.h"
#include "mesh/shapes.h"

using namespace gsp;

TEST_CASE("Draco keeps the faces and gains precision with bits") {
  const Mesh sphere = shapes::sphere(4);
  double last = 1.0;
  std::size_t bytes = 0;
  for (int bits : {8, 10, 12}) {
    const AnchorPoint point = draco_round_trip(sphere, bits);
    CHECK(point.faces == sphere.face_count());
    CHECK(point.decoded.face_count() == sphere.face_count());
    CHECK(point.bytes > bytes);
    bytes = point.bytes;
    double worst = 0.0;
    for (const Vec3& p : point.decoded.positions) worst = std::max(worst, std::abs(p.norm() - 1.0));
    CHECK(worst < last / 2);
    last = worst;
  }
  CHECK_THROWS_AS(draco_round_trip(sphere, 0), Error);
  CHECK_THROWS_AS(draco_round_trip(Mesh{}, 10), Error);
}

TEST_CASE("decimation reaches each face count in one pass and stays near the surface") {
  Progress silent;
  const std::vector<Mesh> meshes = decimate(shapes::sphere(5), {5000, 1000, 200}, silent);
  REQUIRE(meshes.size() == 3);
  const int targets[] = {5000, 1000, 200};
  for (int i = 0; i < 3; ++i) {
    CHECK(meshes[i].face_count() <= targets[i]);
    CHECK(meshes[i].face_count() >= targets[i] - 2);
    for (const Vec3& p : meshes[i].positions) CHECK(std::abs(p.norm() - 1.0) < 1e-6);
  }
  CHECK_THROWS_AS(decimate(shapes::sphere(2), {100, 200}, silent), Error);
}
