#include "remesh/displaced/displaced_remesh.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "mesh/shapes.h"
#include "remesh/displaced/control_system.h"
#include "remesh/displaced/line_walk.h"
#include "remesh/filters/displacement.h"
#include "remesh/remesh.h"
#include "tests/cause_of.h"
#include "tests/remesh/bumpy.h"

using namespace gsp;

namespace {

/// A base quadrisected, each vertex where `place` puts its midpoint-refined one.
template <class Place>
SemiregularMesh placed(const Mesh& base, int level, Place place) {
  Mesh fine = base;
  for (int l = 0; l < level; ++l) fine = shapes::quadrisect(fine);
  for (Vec3& p : fine.positions) p = place(p);
  return {level, base.vertex_count(), base.faces, fine.positions};
}

SemiregularMesh spherical(int level) {
  return placed(shapes::icosahedron(), level, [](const Vec3& p) { return p.normalized(); });
}

/// A disc of radius 1 with a wave across it; its boundary is a circle, which no cubic spline of 8 points is.
SemiregularMesh wavy_disc(int level) {
  const Mesh disc = shapes::sector_disc(8, 0);
  return placed(disc, level, [](const Vec3& p) {
    // Radii of the regular octagon become those of the circle.
    const double turn = std::atan2(p.y(), p.x()), sector = 2.0 * M_PI / 8;
    const double off = turn - sector * std::floor(turn / sector) - sector / 2;
    const double stretch = std::cos(off) / std::cos(sector / 2);
    return Vec3(stretch * p.x(), stretch * p.y(), 0.1 * std::sin(3.0 * stretch * p.x()));
  });
}

SemiregularMesh displaced_to(const SemiregularMesh& surface, int level, Positions positions) {
  Progress progress;
  progress.on_note([](const std::string& note) { FAIL_CHECK(note); });
  DisplacedOptions options;
  options.positions = positions;
  return displaced_remesh(surface, level, options, progress);
}

double largest(const std::vector<double>& numbers) {
  double most = 0.0;
  for (double x : numbers) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

TEST_CASE("a Loop surface gets back its control mesh and no displacements") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::torus(6, 4), shapes::grid(3, 4)}) {
    std::vector<Vec3> control = base.positions;
    const auto levels = subdivision_levels(base.vertex_count(), base.faces, 3);
    // Any grid that is finer than the remesher's own is rounded away, so the control points are taken on that.
    const double grid =
        control_grid_below(bounding_box_diagonal({smooth_surface(levels, control).points, levels.back().faces}) / 512);
    for (Vec3& p : control)
      for (double& x : p) x = grid * 4 * std::nearbyint((x + 0.1 * std::sin(5 * x)) / (4 * grid));
    const SemiregularMesh surface{3, base.vertex_count(), base.faces, smooth_surface(levels, control).points};
    for (Positions positions : {Positions::Sampled, Positions::Fitted}) {
      Progress silent;
      DisplacedOptions options;
      options.positions = positions;
      options.control_bits = 20;
      const SemiregularMesh mesh = displaced_remesh(surface, 3, options, silent);
      REQUIRE(mesh.control);
      double off = 0.0;
      for (int b = 0; b < base.vertex_count(); ++b)
        off = std::max(off, (mesh.control->points[b] - control[b]).cwiseAbs().maxCoeff());
      CHECK(off <= 0.6 * mesh.control->grid);
      // What the grid rounds away of the control points is left to the displacements, and no more.
      const Displacements numbers = displaced_form(mesh).displacements;
      CHECK(largest(numbers.along) < 1.1 * mesh.control->grid);
      CHECK(largest(numbers.across) < 1.1 * mesh.control->grid);
    }
  }
}

TEST_CASE("the points of a control map are those of subdivision") {
  const Mesh base = shapes::grid(3, 4);
  const auto levels = subdivision_levels(base.vertex_count(), base.faces, 3);
  const auto points = ControlMap(levels).points(base.positions),
             expected = smooth_surface(levels, base.positions).points;
  for (std::size_t v = 0; v < points.size(); ++v) CHECK((points[v] - expected[v]).norm() < 1e-14);
}

TEST_CASE("sampled displacements of a sphere end on it, and all base vertices have the same") {
  const SemiregularMesh sphere = spherical(5);
  const SemiregularMesh mesh = displaced_to(sphere, 3, Positions::Sampled);
  // The target's faces lie within their sagitta, an eighth of the squared edge, of the sphere.
  const double edge = 2.0 * std::sin(0.5 * 1.108 / 32);
  for (const Vec3& p : mesh.positions) CHECK(std::abs(p.norm() - 1.0) < edge * edge / 4);
  const DisplacedForm form = displaced_form(mesh);
  CHECK(form.farthest < 1e-14);
  // Up to the grid on which the control points lie.
  for (int b = 1; b < mesh.base_vertices; ++b)
    CHECK(std::abs(form.displacements.along[b] - form.displacements.along[0]) < 2 * mesh.control->grid);
}

TEST_CASE("a fit is nearer to a sphere than samples of it, whose chords lie inside") {
  const SemiregularMesh sphere = spherical(5);
  const auto mean_radius = [](const SemiregularMesh& mesh) {
    const Mesh plain = mesh.mesh();
    double sum = 0.0;
    for (const Triangle& t : plain.faces)
      sum += ((plain.positions[t[0]] + plain.positions[t[1]] + plain.positions[t[2]]) / 3).norm();
    return sum / plain.face_count();
  };
  const double sampled = 1.0 - mean_radius(displaced_to(sphere, 2, Positions::Sampled));
  const double fitted = 1.0 - mean_radius(displaced_to(sphere, 2, Positions::Fitted));
  CHECK(sampled > 0.0);
  CHECK(std::abs(fitted) < 0.7 * sampled);
}

TEST_CASE("a second number takes boundary vertices to a boundary that is no spline") {
  const SemiregularMesh disc = wavy_disc(5);
  for (Positions positions : {Positions::Sampled, Positions::Fitted}) {
    INFO(positions_name(positions));
    const SemiregularMesh mesh = displaced_to(disc, 3, positions);
    const DisplacedForm form = displaced_form(mesh);
    const auto fans = vertex_fans(subdivision_levels(mesh.base_vertices, mesh.base_faces, 3).back());
    for (std::size_t v = 0; v < fans.size(); ++v) {
      if (fans[v].sharp_count == 0) {
        CHECK(form.displacements.across[v] == 0.0);
        continue;
      }
      const Vec3& p = mesh.positions[v];
      CHECK(std::abs(std::hypot(p.x(), p.y()) - 1.0) < 4e-3);
      CHECK(std::abs(p.z() - 0.1 * std::sin(3.0 * p.x())) < 4e-3);
    }
    CHECK(largest(form.displacements.across) > 0.005);
  }
}

TEST_CASE("a walk finds where a line meets its own sheet and not the one behind") {
  // A sheet that is folded back over itself: x from 0 to 2 at z = 0, then back to 0 at z = 1.
  Mesh strip = shapes::grid(4, 2);
  for (Vec3& p : strip.positions)
    if (p.x() > 2.0) p = Vec3(4.0 - p.x(), p.y(), 1.0);
  const SubdivisionLevel level = base_level(strip.vertex_count(), strip.faces);
  const auto hit = walk_to_line(level, strip.positions, 0, Vec3(1.3, 1.6, 5.0), Vec3::UnitZ());
  REQUIRE(hit);
  CHECK(std::abs(*hit + 5.0) < 1e-14);
  CHECK(!walk_to_line(level, strip.positions, 0, Vec3(-0.3, 1.6, 5.0), Vec3::UnitZ()));
  CHECK(!walk_to_line(level, strip.positions, 0, Vec3(1.3, 1.6, 5.0), -Vec3::UnitZ()));
}

TEST_CASE("displaced remeshes are the same bits for any number of threads, and scale with the surface") {
  const Parameterization map = bumpy(shapes::torus(6, 4), 3, 0.02);
  RemeshOptions options;
  options.level = 2;
  options.kind = RemeshKind::Displaced;
  Progress silent;
  std::vector<SemiregularMesh> made;
  for (int threads : {1, 2}) {
    set_thread_count(threads);
    made.push_back(remesh(map, options, silent));
  }
  CHECK(made[0].positions == made[1].positions);
  CHECK(made[0].control->points == made[1].control->points);
  Parameterization larger = map;
  for (Vec3& p : larger.surface.positions) p *= 0x1p40;
  SemiregularMesh scaled = remesh(larger, options, silent);
  for (Vec3& p : scaled.positions) p /= 0x1p40;
  CHECK(scaled.positions == made[0].positions);
  CHECK(scaled.control->grid == 0x1p40 * made[0].control->grid);
}

TEST_CASE("grids of control points are a quarter apart within an octave and never above the step") {
  CHECK(control_grid_below(1.0) == 1.0);
  CHECK(control_grid_below(1.9) == 1.75);
  CHECK(control_grid_below(0.499) == 0.4375);
  for (double step : {0.001, 0.3, 7.7, 1e40, 1e-40}) {
    CHECK(is_control_grid(control_grid_below(step)));
    CHECK(control_grid_below(step) <= step);
    CHECK(control_grid_below(step) > 0.79 * step);
  }
}

TEST_CASE("the coarsest levels have displaced remeshes too") {
  for (int level : {0, 1})
    for (Positions positions : {Positions::Sampled, Positions::Fitted}) {
      const SemiregularMesh mesh =
          displaced_to(placed(shapes::octahedron(), level + 1, [](const Vec3& p) { return p; }), level, positions);
      CHECK(mesh.level == level);
      CHECK(displaced_form(mesh).farthest < 1e-14);
    }
}

TEST_CASE("what cannot be displaced is refused") {
  Progress silent;
  const SemiregularMesh sphere = spherical(2);
  CHECK(cause_of([&] { displaced_remesh(sphere, 3, {}, silent); }) == Cause::BadOption);
  CHECK(cause_of([&] { displaced_remesh(sphere, 1, {Positions::Fitted, 3}, silent); }) == Cause::BadOption);
  SemiregularMesh point = sphere;
  for (Vec3& p : point.positions) p.setZero();
  CHECK(cause_of([&] { displaced_remesh(point, 1, {}, silent); }) == Cause::NoArea);
}
