#include "metrics/smoothness.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "mesh/shapes.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// A flat disc of equilateral base triangles around one corner, mapped isometrically for six sectors.
Parameterization jittered_hexagon(int level, double jitter = 0.19) {
  const Mesh base = shapes::sector_disc(6, 0);
  Parameterization map = exact_maps::quadrisected(base, level);
  exact_maps::jitter(map, jitter, level, 3);
  exact_maps::flatten_onto_base(map, base);
  return map;
}

/// Two unit base triangles that share the edge from (0,0) to (1,0), one above and one below.
Parameterization rhombus(int level) {
  Mesh base;
  base.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, kOmegaIm, 0}, {0.5, -kOmegaIm, 0}};
  base.faces = {{0, 1, 2}, {1, 0, 3}};
  return exact_maps::quadrisected(base, level);
}

}  // namespace

TEST_CASE("linear maps are smooth everywhere, however they are triangulated and charted") {
  Parameterization map = jittered_hexagon(3);
  exact_maps::rechart(map, 5);
  const Eigen::Matrix3d stretch = Eigen::AngleAxisd(1.1, Vec3(1, 1, 0).normalized()).toRotationMatrix() *
                                  Vec3(3.0, 1.0, 1.0).asDiagonal();
  for (Vec3& p : map.surface.positions) p = stretch * p;
  const Smoothness s = smoothness(map);
  CHECK(s.inside_edges > 0);
  CHECK(s.across_edges > 0);
  CHECK(s.corner_edges > 0);
  CHECK(s.all.maximum < 1e-9);
  CHECK(*std::max_element(s.faces.begin(), s.faces.end()) < 1e-9);
}

TEST_CASE("a fold of the surface along an edge is not a lack of smoothness") {
  Parameterization map = rhombus(3);
  for (Vec3& p : map.surface.positions)
    if (p.y() < 0.0) p = Vec3(p.x(), 0.6 * p.y(), 0.8 * p.y());
  CHECK(smoothness(map).all.maximum < 1e-9);
}

TEST_CASE("a kink at a patch edge is seen there, at its size, and nowhere else") {
  const double kink = 0.5;
  for (int level : {3, 5}) {
    Parameterization map = rhombus(level);
    for (Vec3& p : map.surface.positions)
      if (p.y() < 0.0) p.y() *= 1.0 + kink;
    const Smoothness s = smoothness(map);
    // The derivative across the edge is 1 above and 1.5 below, in units in which 2.5 triangles of area are two.
    const double expected = kink / std::sqrt(1.25);
    CHECK(s.across.minimum == Approx(expected));
    CHECK(s.across.maximum == Approx(expected));
    CHECK(s.across_edges == (1 << level) - 2);
    CHECK(s.inside.maximum < 1e-9);
    CHECK(s.at_corner.maximum == Approx(expected));
  }
}

TEST_CASE("inside a smooth map the difference falls with the size of the faces, at a kink it stays") {
  const auto bent = [](int level) {
    Parameterization map = rhombus(level);
    for (Vec3& p : map.surface.positions) p = Vec3(p.x() + 0.2 * p.x() * p.x(), p.y() + (p.y() < 0.0 ? 0.3 * p.y() : 0.0), 0.0);
    return smoothness(map);
  };
  const Smoothness coarse = bent(4), fine = bent(6);
  CHECK(fine.inside.mean == Approx(0.25 * coarse.inside.mean).epsilon(0.1));
  CHECK(fine.across.mean > 0.8 * coarse.across.mean);
}

TEST_CASE("the unit of the surface, its place and the numbering do not matter") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
  exact_maps::jitter(map, 0.19, 3, 8);
  const Smoothness before = smoothness(map);
  exact_maps::rechart(map, 2);
  for (Vec3& p : map.surface.positions) p = 1024.0 * (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * p) + Vec3(1, 2, 3);
  std::reverse(map.surface.faces.begin(), map.surface.faces.end());
  std::reverse(map.face_chart.begin(), map.face_chart.end());
  std::reverse(map.face_corners.begin(), map.face_corners.end());
  const Smoothness after = smoothness(map);
  CHECK(after.inside.mean == Approx(before.inside.mean).epsilon(1e-9));
  CHECK(after.across.p95 == Approx(before.across.p95).epsilon(1e-9));
  CHECK(after.at_corner.mean == Approx(before.at_corner.mean).epsilon(1e-9));
  CHECK(after.across_edges == before.across_edges);
}

TEST_CASE("degenerate faces and empty maps leave finite numbers") {
  Parameterization map = jittered_hexagon(2);
  map.face_corners[5] = {Complex(0, 0), Complex(1, 0), Complex(2, 0)};
  map.surface.positions[map.surface.faces[9][0]] = map.surface.positions[map.surface.faces[9][1]];
  const Smoothness s = smoothness(map);
  CHECK(std::isfinite(s.all.maximum));
  for (double f : s.faces) CHECK(std::isfinite(f));
  CHECK(smoothness(Parameterization{}).all.maximum == 0.0);
}
