#include "metrics/distortion.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "mesh/shapes.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// The flat unit hexagon, mapped isometrically, with points moved about inside.
Parameterization hexagon(int level) {
  const Mesh base = shapes::sector_disc(6, 0);
  Parameterization map = exact_maps::quadrisected(base, level);
  exact_maps::jitter(map, 0.19, level, 3);
  exact_maps::flatten_onto_base(map, base);
  return map;
}

void check_constant(const Statistics& s, double value, double tolerance = 1e-11) {
  CHECK(s.mean == Approx(value).epsilon(tolerance));
  CHECK(s.median == Approx(value).epsilon(tolerance));
  CHECK(s.p95 == Approx(value).epsilon(tolerance));
  CHECK(s.maximum == Approx(value).epsilon(tolerance));
}

}  // namespace

TEST_CASE("an isometry has no distortion, nor has a similarity") {
  for (double scale : {1.0, 1e-3, 250.0}) {
    Parameterization map = hexagon(3);
    const Eigen::AngleAxisd turn(0.7, Vec3(1, -2, 0.5).normalized());
    for (Vec3& p : map.surface.positions) p = scale * (turn * p) + Vec3(5, 6, 7);
    const Distortion d = distortion(map);
    check_constant(d.anisotropy, 1.0, 1e-9);
    check_constant(d.anisotropy_eigenvalues, 1.0, 1e-9);
    check_constant(d.area, 1.0, 1e-9);
    CHECK(d.flipped_faces == 0);
    CHECK(d.degenerate_faces == 0);
  }
}

TEST_CASE("a linear map has its singular values' ratio everywhere, and even areas") {
  for (double ratio : {1.5, 4.0, 1000.0}) {
    Parameterization map = hexagon(2);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d stretch = Vec3(ratio, 1.0, 1.0).asDiagonal();
    const Eigen::Matrix3d tilt = Eigen::AngleAxisd(1.1, Vec3(1, 1, 0).normalized()).toRotationMatrix();
    for (Vec3& p : map.surface.positions) p = tilt * stretch * turn * p;
    const Distortion d = distortion(map);
    check_constant(d.anisotropy, ratio);
    check_constant(d.anisotropy_eigenvalues, ratio * ratio);
    check_constant(d.area, 1.0);
    check_constant(d.area_eigenvalues, 1.0);
  }
}

TEST_CASE("every measure of a linear map by its formula, and its neutral value for an isometry") {
  const double ratio = 4.0;  // singular values 2 and 1/2 in units of equal area
  Parameterization map = hexagon(2);
  const Distortion isometry = distortion(map);
  for (const Statistics* s : {&isometry.stretch_l2, &isometry.stretch_linf, &isometry.sorkine})
    check_constant(*s, 1.0, 1e-9);
  check_constant(isometry.conformal, 2.0);
  check_constant(isometry.area_symmetric, 2.0);
  CHECK(isometry.l2_stretch == Approx(1.0));
  for (Vec3& p : map.surface.positions) p.x() *= ratio;
  const Distortion d = distortion(map);
  check_constant(d.stretch_l2, std::sqrt((4.0 + 0.25) / 2.0));
  check_constant(d.stretch_linf, 2.0);
  check_constant(d.sorkine, 2.0);
  check_constant(d.conformal, 4.25);
  check_constant(d.area_symmetric, 2.0);
  CHECK(d.l2_stretch == Approx(std::sqrt((4.0 + 0.25) / 2.0)));
  CHECK(d.linf_stretch == Approx(2.0));
}

TEST_CASE("the L2 stretch of a map is at least 1, whatever the map") {
  for (int seed = 1; seed <= 5; ++seed) {
    Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
    exact_maps::jitter(map, 0.19, 3, seed);
    const Distortion d = distortion(map);
    CHECK(d.l2_stretch > 1.0);
    CHECK(d.l2_stretch <= d.linf_stretch);
    CHECK(d.sorkine.minimum >= 1.0);
    CHECK(d.area_symmetric.minimum >= 2.0);
  }
}

TEST_CASE("two halves of different area: the weighted mean, median and maximum by hand") {
  // Two base triangles, one four times as large as the other on the surface.
  Mesh base;
  const double h = kOmegaIm;
  base.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {10, 0, 0}, {12, 0, 0}, {11, 2 * h, 0}};
  base.faces = {{0, 1, 2}, {3, 4, 5}};
  const Distortion d = distortion(exact_maps::quadrisected(base, 2));
  // Γ_d is 1 and 4 over the total of 5 per 2 charts; weights 1/5 and 4/5.
  CHECK(d.area.mean == Approx((0.2 * 1.0 + 0.8 * 4.0) / 2.5));
  CHECK(d.area.median == Approx(4.0 / 2.5));
  CHECK(d.area.maximum == Approx(4.0 / 2.5));
  CHECK(d.area_eigenvalues.maximum == Approx(2.56));
  check_constant(d.anisotropy, 1.0, 1e-9);
  const FaceDistortion faces = face_distortion(exact_maps::quadrisected(base, 0));
  CHECK(faces.area[0] == Approx(1.0 / 2.5));
  CHECK(faces.area[1] == Approx(4.0 / 2.5));
}

TEST_CASE("rolling onto a cylinder keeps distances, in the limit") {
  Parameterization map = hexagon(6);
  for (Vec3& p : map.surface.positions) p = Vec3(std::sin(p.x()), p.y(), std::cos(p.x()));
  const Distortion d = distortion(map);
  CHECK(d.anisotropy.maximum < 1.001);
  CHECK(d.area.maximum < 1.001);
}

TEST_CASE("a cone of slope k stretches along its generators by sqrt(1 + k²) only") {
  const double k = 2.0;
  Parameterization map = hexagon(6);
  for (Vec3& p : map.surface.positions) p.z() = k * p.norm();
  const Distortion d = distortion(map);
  CHECK(d.anisotropy.median == Approx(std::sqrt(1.0 + k * k)).epsilon(1e-3));
  CHECK(d.anisotropy.mean == Approx(std::sqrt(1.0 + k * k)).epsilon(1e-2));
  CHECK(d.area.median == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("the unit of the surface and the chart a face is given in do not matter") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
  exact_maps::jitter(map, 0.19, 3, 8);
  const Distortion before = distortion(map);
  exact_maps::rechart(map, 2);
  for (Vec3& p : map.surface.positions) p *= 1024.0;
  const Distortion after = distortion(map);
  CHECK(after.anisotropy.mean == Approx(before.anisotropy.mean).epsilon(1e-12));
  CHECK(after.area.p95 == Approx(before.area.p95).epsilon(1e-10));
  CHECK(before.anisotropy.p95 <= before.anisotropy.maximum);
  CHECK(before.anisotropy.median <= before.anisotropy.p95);
  CHECK(before.anisotropy.median > 1.0);
}

TEST_CASE("flipped and degenerate faces are counted and do not spoil the numbers") {
  Parameterization map = hexagon(2);
  std::swap(map.face_corners[4][0], map.face_corners[4][1]);
  map.face_corners[5] = {Complex(0, 0), Complex(1, 0), Complex(2, 0)};
  map.surface.positions[map.surface.faces[9][0]] = map.surface.positions[map.surface.faces[9][1]];
  const Distortion d = distortion(map);
  CHECK(d.flipped_faces == 2);
  CHECK(d.degenerate_faces >= 1);
  CHECK(std::isfinite(d.anisotropy.mean));
  CHECK(std::isfinite(d.area.maximum));
  const FaceDistortion faces = face_distortion(map);
  CHECK(faces.anisotropy[5] == 0.0);
  CHECK(faces.area[9] == 0.0);
  CHECK(faces.anisotropy[4] >= 1.0);
}

TEST_CASE("a map without faces has zero statistics") {
  const Distortion d = distortion(Parameterization{});
  CHECK(d.anisotropy.mean == 0.0);
  CHECK(d.area.maximum == 0.0);
}
