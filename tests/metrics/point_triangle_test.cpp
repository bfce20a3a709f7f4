#include "mesh/nearest/point_triangle.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "mesh/random.h"
#include "tests/metrics/brute_force.h"

using namespace gsp;

namespace {
double kernel(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const PointGroup<1> point = {{p.x()}, {p.y()}, {p.z()}};
  double squared = std::numeric_limits<double>::infinity();
  nearer<1>(TriangleFrame(a, b, c), point, &squared);
  return squared;
}
}  // namespace

TEST_CASE("distance to each region of a triangle: inside, three edges, three corners") {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
  CHECK(kernel({1, 1, 2}, a, b, c) == Approx(4.0));
  CHECK(kernel({1, 1, -2}, a, b, c) == Approx(4.0));
  CHECK(kernel({1, -2, 0}, a, b, c) == Approx(4.0));
  CHECK(kernel({-3, 1, 0}, a, b, c) == Approx(9.0));
  CHECK(kernel({2 + 3, 1.5 + 4, 0}, a, b, c) == Approx(25.0));
  CHECK(kernel({-3, -4, 0}, a, b, c) == Approx(25.0));
  CHECK(kernel({7, -4, 12}, a, b, c) == Approx(169.0));
  CHECK(kernel({-3, 7, 0}, a, b, c) == Approx(25.0));
  CHECK(kernel({1, 1, 0}, a, b, c) == 0.0);
}

TEST_CASE("the kernel agrees with Ericson's region test on random triangles and points") {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random);
    const Vec3 p = 3.0 * random_point(random);
    CHECK(std::sqrt(kernel(p, a, b, c)) == Approx(brute_force_distance(p, a, b, c)).margin(1e-13));
  }
}

TEST_CASE("the order of the corners does not matter") {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random), p = random_point(random);
    const double d = kernel(p, a, b, c);
    CHECK(kernel(p, b, c, a) == Approx(d).margin(1e-14));
    CHECK(kernel(p, c, b, a) == Approx(d).margin(1e-14));
  }
}

TEST_CASE("a triangle without area is its longest edge, one without extent a point") {
  const Vec3 a(0, 0, 0), b(1, 1, 0), c(3, 3, 0);
  CHECK(kernel({0, 0, 5}, a, c, b) == Approx(25.0));
  CHECK(kernel({2, 2, 1}, b, a, c) == Approx(1.0));
  CHECK(kernel({4, 4, 1}, a, b, c) == Approx(3.0));
  CHECK(kernel({2, 2, 1}, a, a, c) == Approx(1.0));
  CHECK(kernel({1, 2, 3}, a, a, a) == Approx(14.0));
}

TEST_CASE("thin triangles: as near as the nearest point of a fine sampling, and never nearer than the plane allows") {
  Random random(5);
  for (double height : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 a = random_point(random), b = random_point(random);
      const Vec3 c = a + (b - a) * random.uniform() + height * random_point(random);
      const double s = random.uniform(), t = random.uniform() * (1.0 - s);
      const Vec3 on = a + s * (b - a) + t * (c - a);
      // A point at distance D from a point of the triangle is at most that far from the triangle.
      const Vec3 away = random_point(random);
      CHECK(std::sqrt(kernel(on, a, b, c)) < 1e-15 * 8);
      const double distance = std::sqrt(kernel(on + away, a, b, c));
      CHECK(distance <= away.norm() * (1.0 + 1e-14) + 1e-14);
      // And within the height of the distance to the longest edge as a segment.
      const Vec3 ab = b - a;
      const double along = std::clamp((on + away - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      CHECK(distance >= (a + along * ab - on - away).norm() - 4.0 * height - 1e-14);
    }
  }
}
