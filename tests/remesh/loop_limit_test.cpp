#include "remesh/filters/loop_limit.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/shapes.h"
#include "remesh/filters/loop_low_pass.h"
#include "remesh/filters/smooth_surface.h"

using namespace gsp;

namespace {

std::vector<Vec3> filtered(const Filter& filter, const std::vector<Vec3>& x, std::size_t size) {
  std::vector<Vec3> y(size, Vec3::Zero());
  filter.add(x.data(), y.data());
  return y;
}

/// A cone over a ring of k vertices, its tip vertex 0.
Mesh cone(int k, double height) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, height});
  for (int j = 0; j < k; ++j) mesh.positions.push_back({std::cos(2 * M_PI * j / k), std::sin(2 * M_PI * j / k), 0});
  for (int j = 0; j < k; ++j) mesh.faces.push_back({0, 1 + j, 1 + (j + 1) % k});
  return mesh;
}

}  // namespace

TEST_CASE(
    "limit masks are those worked out by hand: 1/2 and 1/12 at valence 6, 2/5 and 1/5 at 3, 2/3 and 1/6 on "
    "boundaries") {
  for (const auto& [k, kept] : {std::pair{6, 0.5}, std::pair{3, 0.4}}) {
    const Mesh mesh = cone(k, 1.0);
    const SubdivisionLevel level = base_level(mesh.vertex_count(), mesh.faces);
    const std::vector<Vec3> limit = filtered(*loop_limit_points(level), mesh.positions, mesh.positions.size());
    CHECK((limit[0] - Vec3(0, 0, kept)).norm() < 1e-14);
    const Vec3 curve = mesh.positions[1] * (2.0 / 3) + (mesh.positions[2] + mesh.positions[k]) / 6;
    CHECK((limit[1] - curve).norm() < 1e-14);
  }
}

TEST_CASE(
    "a limit point and a normal are the same from one level as from the next, at every valence and on boundaries") {
  for (const Mesh& mesh : {cone(3, 0.7), cone(4, 0.7), cone(5, 0.7), cone(6, 0.7), cone(9, 0.7), shapes::icosahedron(),
                           shapes::grid(3, 4), shapes::sector_disc(5, 1)}) {
    const auto levels = subdivision_levels(mesh.vertex_count(), mesh.faces, 3);
    std::vector<Vec3> control = mesh.positions;
    for (std::size_t v = 0; v < control.size(); ++v) control[v].z() += 0.1 * std::sin(3.0 * static_cast<double>(v));
    const SmoothSurface coarse = smooth_surface({levels[0]}, control);
    for (int l = 1; l <= 3; ++l) {
      const SmoothSurface fine = smooth_surface({levels.begin(), levels.begin() + l + 1}, control);
      for (std::size_t v = 0; v < control.size(); ++v) {
        CHECK((fine.points[v] - coarse.points[v]).norm() < 1e-13);
        CHECK((fine.normals[v] - coarse.normals[v]).norm() < 1e-9);
      }
    }
  }
}

TEST_CASE("the limit of a plane is that plane with its normal, and a ball's control mesh looks outwards") {
  const Mesh disc = shapes::sector_disc(7, 2);
  const SmoothSurface plane = smooth_surface(subdivision_levels(disc.vertex_count(), disc.faces, 2), disc.positions);
  for (std::size_t v = 0; v < plane.points.size(); ++v) {
    CHECK(std::abs(plane.points[v].z()) < 1e-15);
    CHECK((plane.normals[v] - Vec3::UnitZ()).norm() < 1e-12);
  }
  const Mesh ball = shapes::icosahedron();
  const SmoothSurface round = smooth_surface(subdivision_levels(ball.vertex_count(), ball.faces, 2), ball.positions);
  for (std::size_t v = 0; v < round.points.size(); ++v)
    CHECK(round.normals[v].dot(round.points[v].normalized()) > 0.99);
}

TEST_CASE("normals of collapsed control meshes are unit vectors still") {
  const Mesh ball = shapes::icosahedron();
  const auto levels = subdivision_levels(ball.vertex_count(), ball.faces, 1);
  for (const Vec3& n : smooth_surface(levels, std::vector<Vec3>(12, Vec3(1, 2, 3))).normals)
    CHECK(n.norm() == Approx(1.0));
}
