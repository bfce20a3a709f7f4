#include "metrics/hausdorff.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "mesh/error.h"
#include "mesh/shapes.h"
#include "tests/by_threads.h"
#include "tests/metrics/brute_force.h"

using namespace gsp;

namespace {

HausdorffBounds bounds(const Mesh& a, const Mesh& b, double tolerance = 0.01) {
  Progress silent;
  HausdorffOptions options;
  options.tolerance = tolerance;
  return hausdorff_bounds(a, b, options, silent);
}

void check_encloses(const DistanceBounds& d, double truth, double tolerance) {
  CHECK(d.lower <= truth * (1.0 + 1e-12));
  CHECK(d.upper >= truth * (1.0 - 1e-12));
  CHECK(d.relative_width() <= tolerance + 1e-9);
}

}  // namespace

TEST_CASE("bounds enclose the offset of planes, however small against the triangles") {
  for (double height : {3.0, 0.25, 1e-3, 1e-6}) {
    const HausdorffBounds h = bounds(shapes::grid(7, 9, 0.0), shapes::grid(7, 9, height));
    check_encloses(h.forward, height, 0.01);
    check_encloses(h.backward, height, 0.01);
  }
}

TEST_CASE("bounds enclose the offset of planes that are divided differently") {
  Mesh other = shapes::grid(5, 4, 0.01);
  for (Vec3& p : other.positions) p = Vec3(p.x() * 7.0 / 5.0, p.y() * 9.0 / 4.0, p.z());
  const HausdorffBounds h = bounds(shapes::grid(7, 9), other);
  check_encloses(h.forward, 0.01, 0.01);
  check_encloses(h.backward, 0.01, 0.01);
}

TEST_CASE("a plane beside a shorter one: the far corners decide, and nothing is missing the other way") {
  const HausdorffBounds h = bounds(shapes::grid(8, 1), shapes::grid(4, 1), 1e-4);
  check_encloses(h.forward, 4.0, 1e-4);
  CHECK(h.backward.lower == 0.0);
  CHECK(h.backward.upper < 1e-11);
  CHECK(h.both().upper == h.forward.upper);
}

TEST_CASE("the distance can be largest inside a face, where two others are equally near") {
  // A point of the segment between two parallel walls at x = -1 and x = 1 is at most 1 away, in the middle.
  Mesh floor, walls;
  floor.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}};
  floor.faces = {{0, 1, 2}, {0, 2, 3}};
  for (double x : {-1.0, 1.0}) {
    const int first = walls.vertex_count();
    for (const Vec3& p : {Vec3(x, 0, -1), Vec3(x, 1, -1), Vec3(x, 1, 1), Vec3(x, 0, 1)}) walls.positions.push_back(p);
    walls.faces.push_back({first, first + 1, first + 2});
    walls.faces.push_back({first, first + 2, first + 3});
  }
  check_encloses(bounds(floor, walls, 1e-3).forward, 1.0, 1e-3);
  check_encloses(bounds(floor, walls, 1e-3).backward, 1.0, 1e-3);
}

TEST_CASE("concentric similar polyhedra: a corner of the outer one is as far as the radii differ") {
  const HausdorffBounds h = bounds(shapes::sphere(4, 1.0), shapes::sphere(4, 1.25), 1e-3);
  check_encloses(h.backward, 0.25, 1e-3);
  CHECK(h.forward.upper <= 0.25 * (1.0 + 2e-3));
}

TEST_CASE("bounds of soups enclose what points find") {
  for (int seed = 1; seed <= 4; ++seed) {
    const Mesh a = random_soup(60, seed), b = random_soup(80, seed + 100);
    const HausdorffBounds h = bounds(a, b);
    CHECK(h.forward.relative_width() <= 0.01);
    double largest = 0.0;
    Random random(seed);
    for (const Vec3& p : a.positions) largest = std::max(largest, brute_force_distance(p, b));
    for (const Triangle& t : a.faces)
      for (int i = 0; i < 60; ++i) {
        double s = random.uniform(), r = random.uniform();
        if (s + r > 1.0) s = 1.0 - s, r = 1.0 - r;
        const Vec3& corner = a.positions[t[0]];
        const Vec3 p = corner + s * (a.positions[t[1]] - corner) + r * (a.positions[t[2]] - corner);
        largest = std::max(largest, brute_force_distance(p, b));
      }
    CHECK(largest <= h.forward.upper);
    CHECK(largest >= 0.9 * h.forward.lower);
  }
}

TEST_CASE("swapping, renumbering and moving the surfaces keep the bounds") {
  const Mesh a = shapes::torus(30, 12), b = shapes::sphere(3);
  const HausdorffBounds ab = bounds(a, b), ba = bounds(b, a);
  CHECK(ab.forward.lower == ba.backward.lower);
  CHECK(ab.forward.upper == ba.backward.upper);
  Mesh turned = a, other = b;
  std::reverse(turned.faces.begin(), turned.faces.end());
  const Eigen::Affine3d motion =
      Eigen::Translation3d(5, -7, 2) * Eigen::AngleAxisd(0.8, Vec3(1, 2, 2).normalized()) * Eigen::Scaling(10.0);
  for (Mesh* mesh : {&turned, &other})
    for (Vec3& p : mesh->positions) p = motion * p;
  const HausdorffBounds moved = bounds(turned, other);
  CHECK(moved.forward.lower <= 10.0 * ab.forward.upper);
  CHECK(moved.forward.upper >= 10.0 * ab.forward.lower);
}

TEST_CASE("equal surfaces are enclosed by zero and rounding; isolated vertices and degenerate faces do no harm") {
  const Mesh torus = shapes::torus(40, 20);
  const DistanceBounds none = bounds(torus, torus).both();
  CHECK(none.lower == 0.0);
  CHECK(none.upper < 1e-12);
  Mesh dirty = torus;
  dirty.positions.push_back(Vec3(100, 100, 100));
  dirty.faces.push_back({3, 3, 3});
  dirty.faces.push_back({3, 4, 4});
  CHECK(bounds(dirty, torus).both().upper < 1e-12);
}

TEST_CASE("bounds are the same for one and two threads, and stay true where pieces run out") {
  const Mesh a = shapes::torus(40, 20), b = shapes::torus(31, 17);
  const auto [one, two] = by_one_and_two_threads([&] { return bounds(a, b); });
  CHECK(one.forward.lower == two.forward.lower);
  CHECK(one.forward.upper == two.forward.upper);
  HausdorffOptions few;
  few.most_pieces = 1;
  Progress silent;
  const HausdorffBounds wide = hausdorff_bounds(a, b, few, silent);
  CHECK(wide.forward.lower <= one.forward.upper);
  CHECK(wide.forward.upper >= one.forward.lower);
  CHECK(wide.forward.upper >= wide.forward.lower);
}

TEST_CASE("where no more pieces may wait, the bounds are wider and still enclose") {
  const Mesh inner = shapes::sphere(1, 1.0), outer = shapes::sphere(4, 1.0);
  HausdorffOptions roomy, narrow;
  roomy.tolerance = narrow.tolerance = 1e-4;
  narrow.most_waiting = 8;
  Progress silent;
  const DistanceBounds tight = hausdorff_bounds(inner, outer, roomy, silent).forward;
  const DistanceBounds wide = hausdorff_bounds(inner, outer, narrow, silent).forward;
  CHECK(tight.relative_width() <= 1e-4);
  CHECK(wide.relative_width() > 1e-4);
  CHECK(wide.lower <= tight.upper);
  CHECK(wide.upper >= tight.lower);
}

TEST_CASE("tolerances out of range are refused") {
  for (double tolerance : {0.0, -1.0, 2.0, std::nan("")})
    CHECK_THROWS_AS(bounds(shapes::sphere(1), shapes::sphere(1), tolerance), Error);
}
