#include "metrics/smoothness.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "mesh/shapes.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// A flat disc of equilateral base triangles around one corner, mapped isometrically for six sectors.
Parameterization jittered_hexagon(int level, double jitter = 0.19, std::uint64_t seed = 3) {
  const Mesh base = shapes::sector_disc(6, 0);
  Parameterization map = exact_maps::quadrisected(base, level);
  exact_maps::jitter(map, jitter, level, seed);
  exact_maps::flatten_onto_base(map, base);
  return map;
}

/// The power z^(6 / sectors), which is smooth around a corner of so many patches, on the middle of a disc of them.
Parameterization power_disc(int sectors, int level, std::uint64_t seed) {
  Parameterization map = exact_maps::quadrisected(shapes::sector_disc(sectors, 0), level);
  exact_maps::jitter(map, 0.19, level, seed);
  const double power = 6.0 / sectors;
  std::vector<char> in_middle(map.surface.positions.size());
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    const Triangle& base = map.base.faces[map.patch[v]];
    const int centre = static_cast<int>(std::find(base.begin(), base.end(), 0) - base.begin());
    const Complex from_centre = (map.position[v] - kChartCorners[centre].value()) /
                                (kChartCorners[(centre + 1) % 3] - kChartCorners[centre]).value();
    // Base face s spans the angles from 2 pi s / sectors.
    const double angle = power * (std::arg(from_centre) + map.patch[v] * std::acos(-1.0) / 3.0);
    const Complex image = std::polar(std::pow(std::abs(from_centre), power), angle);
    map.surface.positions[v] = Vec3(image.real(), image.imag(), 0.0);
    in_middle[v] = std::abs(from_centre) < 0.5;
  }
  Parameterization middle = map;
  middle.surface.faces.clear();
  middle.face_chart.clear();
  middle.face_corners.clear();
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const auto [a, b, c] = map.surface.faces[f];
    if (!in_middle[a] || !in_middle[b] || !in_middle[c]) continue;
    middle.surface.faces.push_back(map.surface.faces[f]);
    middle.face_chart.push_back(map.face_chart[f]);
    middle.face_corners.push_back(map.face_corners[f]);
  }
  return middle;
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
  const Eigen::Matrix3d stretch =
      Eigen::AngleAxisd(1.1, Vec3(1, 1, 0).normalized()).toRotationMatrix() * Vec3(3.0, 1.0, 1.0).asDiagonal();
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
    for (Vec3& p : map.surface.positions)
      p = Vec3(p.x() + 0.2 * p.x() * p.x(), p.y() + (p.y() < 0.0 ? 0.3 * p.y() : 0.0), 0.0);
    return smoothness(map);
  };
  const Smoothness coarse = bent(4), fine = bent(6);
  CHECK(fine.inside.mean == Approx(0.25 * coarse.inside.mean).epsilon(0.1));
  CHECK(fine.across.mean > 0.8 * coarse.across.mean);
}

TEST_CASE("patch edges of a smooth map do not show, however fine or uneven its faces are") {
  for (int level : {5, 6})
    for (std::uint64_t seed : {1, 2, 3}) {
      Parameterization map = jittered_hexagon(level, 0.19, seed);
      for (Vec3& p : map.surface.positions)
        p = Vec3(p.x() + 0.1 * std::sin(2.0 * p.y() + 1.0), p.y() + 0.05 * p.x() * p.x(),
                 0.3 * std::cos(p.x() - p.y()));
      CHECK(smoothness(map).across_over_inside.value() == Approx(1.0).margin(0.06));
    }
}

TEST_CASE("nor do they at a corner where every smooth map is singular, though the group's mean is larger") {
  for (int sectors : {5, 7, 9})
    for (int level : {5, 6}) {
      const Smoothness s = smoothness(power_disc(sectors, level, sectors));
      CHECK(s.across.mean > 1.2 * s.inside.mean);
      CHECK(s.across_over_inside.value() == Approx(1.0).margin(0.06));
    }
}

TEST_CASE("a kink at patch edges shows, twice as much in faces of half the size, and on some of the edges still") {
  const auto bend = [](Parameterization map) {
    for (Vec3& p : map.surface.positions)
      p = Vec3(p.x() + 0.1 * p.x() * p.x(), p.y() + 0.1 * p.x() * p.y() + (p.y() < 0.0 ? 0.5 * p.y() : 0.0), 0.0);
    return smoothness(map).across_over_inside.value();
  };
  const double coarse = bend(rhombus(5)), fine = bend(rhombus(6));
  CHECK(coarse > 5.0);
  CHECK(fine == Approx(2.0 * coarse).epsilon(0.1));
  CHECK(bend(jittered_hexagon(6)) > 1.5);
}

TEST_CASE("where a map is linear inside its patches there is nothing to compare patch edges with") {
  CHECK_FALSE(smoothness(jittered_hexagon(4)).across_over_inside);
  Parameterization kinked = rhombus(4);
  for (Vec3& p : kinked.surface.positions)
    if (p.y() < 0.0) p.y() *= 1.5;
  CHECK_FALSE(smoothness(kinked).across_over_inside);
  CHECK_FALSE(smoothness(Parameterization{}).across_over_inside);
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
  CHECK(after.across_over_inside.value() == Approx(before.across_over_inside.value()).epsilon(1e-9));
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

TEST_CASE("an edge whose middle lies on a corner has no distance from it, and does no harm") {
  Parameterization map = rhombus(3);
  // The middle of the edge from corner 0 to corner 1 of the first face goes to a lattice point, as a fold may bring it.
  const Complex middle = 0.5 * (map.face_corners[0][0] + map.face_corners[0][1]);
  for (auto& corners : map.face_corners)
    for (Complex& z : corners) z -= middle;
  const Smoothness s = smoothness(map);
  CHECK(std::isfinite(s.all.mean));
  CHECK((!s.across_over_inside || std::isfinite(*s.across_over_inside)));
}
