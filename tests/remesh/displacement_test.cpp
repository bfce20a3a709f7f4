#include "remesh/filters/displacement.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/error.h"
#include "remesh/filters/loop_limit.h"
#include "remesh/semiregular_file.h"
#include "tests/cause_of.h"
#include "tests/coder/displaced_meshes.h"
#include "tests/temporary_folder.h"

using namespace gsp;

TEST_CASE("conormals of a flat grid point out of its sides, and inside there are none") {
  const Mesh grid = shapes::grid(3, 4);
  const SubdivisionLevel level = base_level(grid.vertex_count(), grid.faces);
  const auto conormals =
      loop_limit_conormals(level, grid.positions, std::vector<Vec3>(grid.positions.size(), Vec3::UnitZ()));
  for (int v = 0; v < grid.vertex_count(); ++v) {
    const double x = grid.positions[v].x(), y = grid.positions[v].y();
    const Vec3 out(x == 0.0 ? -1.0 : x == 3.0 ? 1.0 : 0.0, y == 0.0 ? -1.0 : y == 4.0 ? 1.0 : 0.0, 0.0);
    CHECK((conormals[v] - (out.isZero() ? out : out.normalized())).norm() < 1e-15);
  }
}

TEST_CASE(
    "moves across a boundary go on inside, half as far at each vertex between one that moves and one that does not") {
  const Mesh grid = shapes::grid(4, 4);
  const auto levels = subdivision_levels(grid.vertex_count(), grid.faces, 2);
  const SmoothSurface surface = smooth_surface(levels, grid.positions);
  const std::vector<double> across(surface.points.size(), 0.25);
  const std::vector<Vec3> moves = moves_across(levels, surface, across);
  const std::vector<Vec3> still = moves_across(levels, surface, across, AcrossRule::AtBoundary);
  int checked = 0;
  for (std::size_t v = 0; v < moves.size(); ++v) {
    // The spline's side is at x = 0, the base's vertices inside at x = 1 and on; corners are far from y = 2.
    const Vec3& p = surface.points[v];
    if (std::abs(p.y() - 2.0) > 0.6) continue;
    const double toward_left = std::max(1.0 - p.x(), 0.0), toward_right = std::max(p.x() - 3.0, 0.0);
    CHECK((moves[v] - Vec3(0.25 * (toward_right - toward_left), 0.0, 0.0)).norm() < 0.02);
    CHECK((still[v].isZero(0.0) || p.x() < 0.1 || p.x() > 3.9));
    ++checked;
  }
  CHECK(checked > 40);
}

TEST_CASE("numbers read off a displaced mesh are those that it was made of") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(3, 4), shapes::torus(6, 4)}) {
    const SemiregularMesh mesh = samples::displaced(base, 2);
    const DisplacedForm form = displaced_form(mesh);
    CHECK(form.farthest < 1e-15);
    const auto levels = subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level);
    const SmoothSurface surface = smooth_surface(levels, mesh.control->points);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3& p = surface.points[v];
      CHECK(std::abs(form.displacements.along[v] - 0.1 * std::sin(3.0 * p.x() + p.y())) < 1e-14);
      const double across = surface.conormals[v].isZero() ? 0.0 : 0.05 * std::cos(2.0 * p.x() - p.y());
      CHECK(std::abs(form.displacements.across[v] - across) < 1e-14);
    }
  }
}

TEST_CASE("a control mesh that does not belong to its mesh is refused") {
  const SemiregularMesh good = samples::displaced(shapes::icosahedron(), 2);
  const auto cause = [](const SemiregularMesh& mesh) { return cause_of([&] { displaced_form(mesh); }); };
  SemiregularMesh bad = good;
  bad.control->points[3].x() += bad.control->grid;
  CHECK(cause(bad) == Cause::Malformed);
  bad = good;
  bad.control->points[3].x() += 0.3 * bad.control->grid;
  CHECK(cause(bad) == Cause::Malformed);
  bad = good;
  bad.control->points.pop_back();
  CHECK(cause(bad) == Cause::Malformed);
  bad = good;
  bad.positions.pop_back();
  CHECK(cause(bad) == Cause::Malformed);
  bad = good;
  bad.control->points[0].y() = NAN;
  CHECK(cause(bad) == Cause::NonFinite);
  for (double grid : {0.0, -0.0625, 0.1, 9.0 / 128, double(INFINITY), std::ldexp(1.0, -600)}) {
    bad = good;
    bad.control->grid = grid;
    CHECK(cause(bad) == Cause::Malformed);
  }
}

TEST_CASE("a displaced mesh comes back from its file with its control points, bit for bit") {
  const TemporaryFolder folder;
  const SemiregularMesh mesh = samples::displaced(shapes::grid(3, 4), 3);
  const std::string path = folder.file("displaced.sr.ply");
  write_semiregular(path, mesh, {"kind displaced"});
  const SemiregularMesh read = read_semiregular(path);
  CHECK(read.positions == mesh.positions);
  CHECK(read.base_faces == mesh.base_faces);
  REQUIRE(read.control);
  CHECK(read.control->points == mesh.control->points);
  CHECK(read.control->grid == mesh.control->grid);
}
