#include "metrics/psnr.h"

#include <catch2/catch.hpp>

#include "mesh/io.h"
#include "mesh/ply.h"
#include "mesh/shapes.h"
#include "metrics/picture.h"
#include "tests/temporary_folder.h"

using namespace gsp;

namespace {
Psnr d2(const Mesh& a, const Mesh& b) {
  Progress silent;
  return mpeg_d2_psnr(a, SurfaceTree(a), b, SurfaceTree(b), {20000, 1}, silent);
}
Psnr d1(const Mesh& a, const Mesh& b) {
  Progress silent;
  return mpeg_d1_psnr(a, surface_distance(a, b, {20000, 1}, silent));
}
}  // namespace

TEST_CASE("offset planes: every PSNR by its own formula") {
  const Mesh a = shapes::grid(8, 6), b = shapes::grid(8, 6, 0.5);
  Progress silent;
  const Psnr diagonal = diagonal_psnr(surface_distance(a, b, {20000, 1}, silent));
  CHECK(diagonal.peak == Approx(10.0));
  CHECK(diagonal.db == Approx(20.0 * std::log10(10.0 / 0.5)));
  CHECK(d1(a, b).peak == Approx(8.0));
  CHECK(d1(a, b).db == Approx(10.0 * std::log10(3.0 * 64.0 / 0.25)));
  CHECK(d2(a, b).db == Approx(d1(a, b).db));
}

TEST_CASE("an error along the surface counts for D1 and not for D2") {
  const Mesh a = shapes::grid(8, 1), b = shapes::grid(4, 1);
  CHECK(d1(a, b).db == Approx(10.0 * std::log10(3.0 * 64.0 / (8.0 / 3.0))).epsilon(1e-4));
  CHECK(std::isinf(d2(a, b).db));
}

TEST_CASE("D2 is never under D1") {
  const Mesh a = shapes::sphere(3), b = shapes::torus(30, 12, 0.8, 0.3);
  CHECK(d2(a, b).db >= d1(a, b).db - 0.01);
}

TEST_CASE("pictures carry the numbers, gray at neutral and red at full") {
  const TemporaryFolder folder;
  const Mesh mesh = shapes::tetrahedron();
  const std::string vertices = folder.file("v.ply"), faces = folder.file("f.ply");
  write_vertex_picture(vertices, mesh, {{"distance", {0.0, 1.0, 2.0, std::nan("")}}}, {0.0, 2.0});
  const PlyDocument v = read_ply(vertices);
  CHECK(v.find("vertex")->scalar("distance")->values == std::vector<double>{0.0, 1.0, 2.0, 0.0});
  CHECK(v.find("vertex")->scalar("red")->values[0] == v.find("vertex")->scalar("green")->values[0]);
  CHECK(v.find("vertex")->scalar("red")->values[2] > 4 * v.find("vertex")->scalar("green")->values[2]);
  CHECK(read_mesh(vertices).faces == mesh.faces);
  write_face_picture(faces, mesh, {{"area", {1, 2, 3, 4}}, {"other", {5, 6, 7, 8}}}, {1.0, 4.0});
  const PlyDocument f = read_ply(faces);
  CHECK(f.find("face")->scalar("quality")->values == std::vector<double>{1, 2, 3, 4});
  CHECK(f.find("face")->scalar("other")->values == std::vector<double>{5, 6, 7, 8});
}
