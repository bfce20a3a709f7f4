#include "metrics/metro.h"

#include <catch2/catch.hpp>

#include "mesh/error.h"
#include "mesh/shapes.h"

using namespace gsp;

namespace {
MetroDistances metro(const Mesh& a, const Mesh& b, std::size_t samples) {
  Progress silent;
  return metro_distances(a, SurfaceTree(a), b, SurfaceTree(b), samples, silent);
}
}  // namespace

TEST_CASE("offset planes are their offset apart by any averaging") {
  const MetroDistances d = metro(shapes::grid(8, 8), shapes::grid(8, 8, 0.25), 0);
  CHECK(d.forward.mean == Approx(0.25));
  CHECK(d.forward.rms == Approx(0.25));
  CHECK(d.backward.maximum == Approx(0.25));
}

TEST_CASE("samples are counted by hand on a square of two faces") {
  // 100 asked for: 4 vertices; edges at sqrt(96) = 9.80 per length get 9, 9, 13, 10, 10 or so: 4 + √2 lengths, 53 in
  // all. What is left for faces is 96 - (4 + 53), vertices taken off twice; 19.5 a face: 5 rows of an inner grid, 15
  // points, then 24 are owed and 6 rows give 21.
  const Mesh square = shapes::grid(1, 1);
  const MetroDistances d = metro(square, square, 100);
  CHECK(d.forward.vertex_samples == 4);
  CHECK(d.forward.edge_samples == static_cast<std::size_t>((4.0 + std::sqrt(2.0)) * std::sqrt(96.0)));
  CHECK(d.forward.face_samples == 15 + 21);
  CHECK(d.forward.maximum < 1e-15);
}

TEST_CASE("vertices weigh as much as areas: a spike counts more than by area") {
  Mesh spiked = shapes::grid(4, 4);
  spiked.positions[12].z() = 1.0;
  const MetroDistances d = metro(spiked, shapes::grid(4, 4), 25);
  // Vertices use up the target: the mean is over them alone.
  CHECK(d.forward.edge_samples == 0);
  CHECK(d.forward.face_samples == 0);
  CHECK(d.forward.mean == Approx(1.0 / 25.0));
  CHECK(d.forward.rms == Approx(0.2));
}

TEST_CASE("the diagonal is that of the joint box, widened by 2% on every side") {
  const Mesh cube = shapes::tetrahedron();
  const double plain = std::sqrt(12.0);
  CHECK(metro(cube, shapes::sphere(1, 0.5), 1000).diagonal == Approx(plain * (1.0 + 0.04 * std::sqrt(3.0))));
}

TEST_CASE("what Metro cannot sample is refused") {
  Mesh line = shapes::sphere(1);
  line.faces = {{0, 1, 1}};
  CHECK_THROWS_AS(metro(line, shapes::sphere(1), 100), Error);
  CHECK_THROWS_AS(metro(shapes::sphere(1), shapes::sphere(1), 3'000'000'000), Error);
}
