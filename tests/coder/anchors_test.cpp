#include "coder/anchors.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "mesh/error.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"

using namespace gsp;

namespace {

// The cube [-1, 1]³ with n quadrisected faces, turned and far from the origin, so that no plane is along an axis.
struct TurnedCube {
  Mesh mesh;
  Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Vec3::UnitX()) * Eigen::AngleAxisd(0.4, Vec3::UnitZ())).matrix();
  Vec3 offset = Vec3(300.0, -200.0, 100.0);

  explicit TurnedCube(int level) {
    for (int v = 0; v < 8; ++v) mesh.positions.emplace_back(v & 1 ? 1 : -1, v & 2 ? 1 : -1, v & 4 ? 1 : -1);
    mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    for (int i = 0; i < level; ++i) mesh = shapes::quadrisect(mesh);
    for (Vec3& p : mesh.positions) p = turn * p + offset;
  }
  Vec3 back(const Vec3& p) const { return turn.transpose() * (p - offset); }
};

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.faces)
    sum += mesh.positions[t[0]].cross(mesh.positions[t[1]]).dot(mesh.positions[t[2]]) / 6.0;
  return sum;
}

constexpr Decimation kDecimations[] = {Decimation::Quadrics, Decimation::Volume};

}  // namespace

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
  // Coordinates as they are: single precision, 12 bytes a vertex beside the connectivity.
  const AnchorPoint lossless = draco_round_trip(sphere, std::nullopt);
  CHECK(lossless.bytes > 12 * sphere.positions.size());
  CHECK(lossless.bytes < 13 * sphere.positions.size());
  for (const Vec3& p : lossless.decoded.positions) CHECK(std::abs(p.norm() - 1.0) < 1e-7);
  CHECK_THROWS_AS(draco_round_trip(sphere, 0), Error);
  CHECK_THROWS_AS(draco_round_trip(Mesh{}, 10), Error);
}

TEST_CASE("decimation reaches each face count in one pass and stays near the surface", "[slow]") {
  Progress silent;
  for (const Decimation decimation : kDecimations) {
    const std::vector<Mesh> meshes = decimate(shapes::sphere(5), {20480, 5000, 1000, 200}, decimation, silent);
    REQUIRE(meshes.size() == 4);
    CHECK(meshes[0].positions == shapes::sphere(5).positions);
    const int targets[] = {20480, 5000, 1000, 200};
    for (int i = 1; i < 4; ++i) {
      CHECK(meshes[i].face_count() <= targets[i]);
      CHECK(meshes[i].face_count() >= targets[i] - 2);
      // A face that spans the angle α goes 1 - cos(α/2) deep; 4π = faces · √3/4 · α².
      const double depth = 4.0 * 3.1416 / (std::sqrt(3.0) * targets[i]);
      for (const Vec3& p : meshes[i].positions) CHECK(std::abs(p.norm() - 1.0) < 2.0 * depth);
    }
    CHECK_THROWS_AS(decimate(shapes::sphere(2), {100, 200}, decimation, silent), Error);
    CHECK_THROWS_AS(decimate(shapes::sphere(2), {0}, decimation, silent), Error);
    CHECK(decimate(shapes::sphere(2), {}, decimation, silent).empty());
  }
}

TEST_CASE("a cube of many faces becomes the cube of twelve") {
  Progress silent;
  const TurnedCube cube(3);
  for (const Decimation decimation : kDecimations) {
    const std::vector<Mesh> meshes = decimate(cube.mesh, {100, 12}, decimation, silent);
    REQUIRE(meshes.size() == 2);
    for (const Mesh& mesh : meshes)
      for (const Vec3& p : mesh.positions) CHECK(std::abs(cube.back(p).lpNorm<Eigen::Infinity>() - 1.0) < 1e-9);
    REQUIRE(meshes[1].vertex_count() == 8);
    for (const Vec3& p : meshes[1].positions)
      for (int k = 0; k < 3; ++k) CHECK(std::abs(std::abs(cube.back(p)[k]) - 1.0) < 1e-9);
    CHECK(surface_area(meshes[0]) == Approx(24.0));
  }
}

TEST_CASE(
    "Lindstrom and Turk's collapses keep a sphere's volume, quadrics lift its vertices by a quarter square radius") {
  Progress silent;
  const Mesh sphere = shapes::sphere(5);
  const std::vector<Mesh> kept = decimate(sphere, {1000, 100}, Decimation::Volume, silent);
  REQUIRE(kept.size() == 2);
  for (const Mesh& mesh : kept) CHECK(volume(mesh) == Approx(volume(sphere)).epsilon(1e-9));
  const std::vector<Mesh> lifted = decimate(sphere, {1000, 100}, Decimation::Quadrics, silent);
  REQUIRE(lifted.size() == 2);
  for (const Mesh& mesh : lifted) {
    // The tangent planes over a cap of angular radius r, with r² π the area of two faces, leave the least sum of
    // squares at <cos> / <cos²> = 1 + r² / 4 from the centre. Flat faces between such vertices still have less than the
    // volume.
    const double lift = 8.0 / mesh.face_count() / 4.0;
    double mean = 0.0;
    for (const Vec3& p : mesh.positions) mean += p.norm() / mesh.vertex_count();
    CHECK(mean - 1.0 > 0.6 * lift);
    CHECK(mean - 1.0 < 1.4 * lift);
    CHECK(volume(mesh) < volume(sphere));
  }
}

TEST_CASE("decimation keeps boundaries, components and what has no face to spare") {
  Progress silent;
  const Mesh square = shapes::grid(16, 16, 3.0);
  const Mesh two = shapes::twice(shapes::sphere(3), {4.0, 0.0, 0.0});
  for (const Decimation decimation : kDecimations) {
    const std::vector<Mesh> flat = decimate(square, {40, 2}, decimation, silent);
    REQUIRE(!flat.empty());
    for (const Mesh& mesh : flat) {
      CHECK(surface_area(mesh) == Approx(256.0));
      CHECK(bounding_box_diagonal(mesh) == Approx(bounding_box_diagonal(square)));
    }
    const std::vector<Mesh> spheres = decimate(two, {200}, decimation, silent);
    REQUIRE(spheres.size() == 1);
    CHECK(topology_report(spheres[0]).components.size() == 2);
    // A tetrahedron is the least closed surface: it is all that there is of smaller counts.
    const std::vector<Mesh> tetrahedron = decimate(shapes::tetrahedron(), {100, 4, 3}, decimation, silent);
    REQUIRE(tetrahedron.size() == 2);
    CHECK(tetrahedron[1].positions == shapes::tetrahedron().positions);
  }
}

TEST_CASE("a surface that two fans of faces pinch at a vertex is not decimated, and the vertex is named") {
  Mesh pinched = shapes::twice(shapes::sphere(3), Vec3(2.0, 0.0, 0.0));
  const int second = pinched.vertex_count() / 2;
  for (Triangle& t : pinched.faces)
    for (int& v : t)
      if (v == second) v = 0;
  Progress silent;
  for (Decimation decimation : {Decimation::Quadrics, Decimation::Volume}) try {
      decimate(pinched, {100}, decimation, silent);
      FAIL("accepted");
    } catch (const Error& e) {
      CHECK(e.cause() == Cause::NonManifoldVertex);
      CHECK(e.index() == 0);
    }
}
