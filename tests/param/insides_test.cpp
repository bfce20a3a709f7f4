#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "mesh/shapes.h"
#include "param/atlas/best_map.h"
#include "param/atlas/folds.h"
#include "param/map/convex_clip.h"
#include "param/map/lattice_motion.h"
#include "param/map/tolerances.h"
#include "param/removal/flatten.h"
#include "param/removal/location.h"
#include "param/removal/triangle_complex.h"
#include "param/shortening.h"
#include "param/simplify/automatic_stop.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

double area_of(const std::vector<Complex>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

/// The star of a vertex in a mesh as it is.
Star star_of(const Mesh& mesh, int vertex) {
  const Surface surface(mesh);
  Star star;
  TriangleComplex(surface).gather(vertex, star);
  return star;
}

/// A pyramid of `sides` equal sides over a regular polygon: apex 0 at a height over the middle.
Mesh pyramid(int sides, double height) {
  Mesh mesh;
  mesh.positions.push_back({0.0, 0.0, height});
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.0});
    mesh.faces.push_back({0, 1 + k, 1 + (k + 1) % sides});
  }
  return mesh;
}

}  // namespace

TEST_CASE("a convex polygon clipped by a line keeps what lies to its left") {
  const std::vector<Complex> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Complex> left = square;
  clip_to_left(left, {0.25, 0.0}, {0.25, 1.0});  // upward: left is x < 1/4
  CHECK(area_of(left) == Approx(0.25));
  CHECK(std::abs(mean(left) - Complex(0.125, 0.5)) < 1e-15);
  std::vector<Complex> corner = square;
  clip_to_left(corner, {1.0, 0.5}, {0.5, 1.0});  // the corner at (1, 1) goes, an eighth
  CHECK(area_of(corner) == Approx(7.0 / 8.0));
  CHECK(corner.size() == 5);
  std::vector<Complex> none = square;
  clip_to_left(none, {2.0, 1.0}, {2.0, 0.0});  // downward beyond it: nothing is left of it but all is
  CHECK(none.empty());
}

TEST_CASE("two points say which lattice motion took them, unless they are not as far apart") {
  const Complex a = Eisenstein{2, -1}.value(), b = Eisenstein{3, 1}.value();
  for (int k = 0; k < 6; ++k) {
    const Transition motion{k, {5, -3}};
    const auto found = lattice_motion(a, b, motion.apply(a), motion.apply(b));
    REQUIRE(found);
    CHECK(*found == motion);
    const Complex c(0.21, 0.37), d(0.4, -0.1);  // no lattice points
    const auto within = lattice_motion_within(1e-9, c, d, motion.apply(c), motion.apply(d));
    REQUIRE(within);
    CHECK(*within == motion);
  }
  CHECK(!lattice_motion(a, b, a, a + Complex(1.0)));
  CHECK(!lattice_motion_within(1e-9, a, b, a + Complex(0.5), b + Complex(0.5)));  // no lattice shift
}

TEST_CASE("a pyramid's star flattens to equal angles that sum to a full turn, at equal radii") {
  for (int sides : {3, 4, 6, 9, 200})
    for (double height : {0.0, 1.0, 3.0}) {
      INFO(sides << " sides, height " << height);
      const Mesh mesh = pyramid(sides, height);
      const Star star = star_of(mesh, 0);
      REQUIRE(star.size() == sides);
      CHECK(!star.boundary);
      std::vector<Complex> ring;
      flatten_star(mesh.positions, star, ring);
      for (int k = 0; k < sides; ++k) {
        CHECK(std::abs(ring[k]) == Approx(1.0));
        CHECK(std::arg(ring[(k + 1) % sides] / ring[k]) == Approx(2.0 * std::numbers::pi / sides));
      }
    }
}

TEST_CASE("a boundary star flattens to a half disc with its ends on the real axis") {
  const Mesh mesh = shapes::grid(4, 4);
  const Star star = star_of(mesh, 2);  // on the lower side: faces from 0 to 180 degrees
  REQUIRE(star.boundary);
  std::vector<Complex> ring;
  flatten_star(mesh.positions, star, ring);
  CHECK(std::abs(ring.front().imag()) < 1e-12);
  CHECK(std::abs(ring.back().imag()) < 1e-12);
  CHECK(ring.front().real() > 0.0);
  CHECK(ring.back().real() < 0.0);
  double angle = 0.0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) angle += std::arg(ring[k + 1] / ring[k]);
  CHECK(angle == Approx(std::numbers::pi));
}

TEST_CASE("barycentric coordinates, and a point of a star's triangle in the flattened ring") {
  const auto w = barycentric({0.25, 0.5}, {0, 0}, {1, 0}, {0, 1});
  CHECK(w[0] == Approx(0.25));
  CHECK(w[1] == Approx(0.25));
  CHECK(w[2] == Approx(0.5));
  const Mesh mesh = pyramid(5, 1.0);
  const Surface surface(mesh);
  const TriangleComplex complex(surface);
  Star star;
  complex.gather(0, star);
  std::vector<Complex> ring;
  flatten_star(mesh.positions, star, ring);
  for (int k = 0; k < star.size(); ++k) {
    Location at{star.triangles[k], 0.0, 0.0};
    double* const weights[2] = {&at.weight1, &at.weight2};
    const int toward = (complex.corner_index(at.triangle, 0) + 1) % 3;  // the corner that is ring[k]
    if (toward > 0) *weights[toward - 1] = 1.0;
    CHECK(std::abs(flat_in_star(complex, star, ring, k, at) - ring[k]) < 1e-15);
  }
}

TEST_CASE("a vertex taken out of the complex leaves the triangles that fill its hole, with their neighbours") {
  const Mesh mesh = shapes::octahedron();
  const Surface surface(mesh);
  TriangleComplex complex(surface);
  Star star;
  complex.gather(0, star);
  REQUIRE(star.size() == 4);
  CHECK(!complex.edge_exists(star.ring[0], star.ring[2]));
  CHECK(complex.component_vertices(0) == 6);
  std::vector<int> slots;
  complex.replace(star, {{0, 1, 2}, {0, 2, 3}}, slots);
  REQUIRE(slots.size() == 2);
  CHECK(complex.edge_exists(star.ring[0], star.ring[2]));
  CHECK(complex.component_vertices(star.ring[0]) == 5);
  CHECK(complex.edge_towards(slots[0], slots[1]) >= 0);
  int alive = 0;
  for (int t = 0; t < complex.slot_count(); ++t) {
    if (!complex.alive(t)) continue;
    ++alive;
    CHECK(complex.corner_index(t, 0) < 0);
    for (int k = 0; k < 3; ++k) CHECK(complex.neighbour(t, k) >= 0);
  }
  CHECK(alive == 6);  // 2·5 - 4
}

TEST_CASE("the automatic stop comes where metric distortion has taken over, and never in the first stage") {
  const auto record = [](int remaining, double quality, double metric) {
    OmegaRecord r;
    r.remaining_vertices = remaining;
    r.shape = quality;
    r.metric = metric;
    return r;
  };
  AutomaticStop calm(10000);
  for (int n = 9999; n > 4; --n) CHECK(!calm.reached(record(n, 1.0, 0.1)));
  AutomaticStop early(10000);
  for (int n = 9999; n >= 1000; --n) REQUIRE(!early.reached(record(n, 1.0, 10.0)));
  CHECK(early.reached(record(999, 1.0, 10.0)));
  AutomaticStop turning(10000);
  int stopped = 0;
  for (int n = 9999; n > 4 && stopped == 0; --n)
    if (turning.reached(record(n, 1.0, n > 500 ? 0.0 : 1.0))) stopped = n;
  CHECK(stopped <= 500);
  CHECK(stopped > 480);  // a quarter of the window's weight: log(4/3) windows of 5% of 500, and 8
}

TEST_CASE("a rod of long faces is pressed together and drawn out again, a sphere is left alone") {
  CHECK(!Shortening(shapes::sphere(3)).any());
  Mesh rod = shapes::torus(12, 12);
  for (Vec3& p : rod.positions) p.x() *= 200.0;
  const Shortening shortening(rod);
  REQUIRE(shortening.any());
  Mesh image = rod;
  shortening.press(image);
  const auto length = [](const Mesh& mesh) {
    double least = 1e300, most = -1e300;
    for (const Vec3& p : mesh.positions) {
      least = std::min(least, p.x());
      most = std::max(most, p.x());
    }
    return most - least;
  };
  CHECK(length(image) < 0.2 * length(rod));
  shortening.draw_out(image);
  for (std::size_t v = 0; v < rod.positions.size(); ++v)
    CHECK((image.positions[v] - rod.positions[v]).norm() < 1e-12 * length(rod));
}

TEST_CASE("a vertex off its place by less than the tolerance is where it was, by more it is misplaced") {
  const Parameterization exact = exact_maps::quadrisected(shapes::icosahedron(), 1);
  for (double share : {0.5, 2.0}) {
    Parameterization map = exact;
    map.position[0] += share * tolerance::kSamePlace;  // a base vertex, whose corner of the chart is its place
    CHECK(check_map(map).misplaced_vertices == (share > 1.0));
  }
  // A point outside of the chart by rounding is on its edge.
  CHECK(inside_chart({0.5, -0.5 * tolerance::kOnEdge}));
  CHECK_FALSE(inside_chart({0.5, -2.0 * tolerance::kOnEdge}));
  const double height = 2.0 * tolerance::kUprightArea;
  CHECK(upright({0, 0}, {1, 0}, {0, 1.01 * height}));
  CHECK_FALSE(upright({0, 0}, {1, 0}, {0, 0.99 * height}));
}
