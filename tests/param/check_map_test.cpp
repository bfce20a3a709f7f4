#include <catch2/catch.hpp>

#include <algorithm>

#include "mesh/error.h"
#include "mesh/halfedges.h"
#include "mesh/shapes.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {
const std::vector<Mesh>& bases() {
  static const std::vector<Mesh> all = {
      shapes::tetrahedron(),       shapes::octahedron(),      shapes::icosahedron(),
      shapes::lattice_torus(4, 5), shapes::sector_disc(3, 0), shapes::sector_disc(6, 1),
      shapes::sector_disc(12, 0),  shapes::grid(2, 3),        shapes::twice(shapes::octahedron(), Vec3(5, 0, 0))};
  return all;
}
}  // namespace

TEST_CASE("identity maps are valid at every level") {
  for (const Mesh& base : bases())
    for (int level = 0; level <= 3; ++level) {
      const MapCheck check = check_map(exact_maps::quadrisected(base, level));
      CHECK(check.valid());
      CHECK(check.area_error < 1e-14);
    }
}

TEST_CASE("moved points and other charts are still valid") {
  for (const Mesh& base : bases())
    for (int level = 1; level <= 3; ++level) {
      Parameterization map = exact_maps::quadrisected(base, level);
      exact_maps::jitter(map, 0.19, level, 7);
      CHECK(check_map(map).valid());
      exact_maps::rechart(map, 8);
      const MapCheck check = check_map(map);
      CHECK(check.valid());
      CHECK(check.area_error < 1e-13);
    }
}

TEST_CASE("a flipped and a degenerate face are counted, the first one named") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 2);
  std::swap(map.face_corners[5][1], map.face_corners[5][2]);
  CHECK(check_map(map).flipped_faces == 1);
  CHECK(check_map(map).first_flipped == 5);
  CHECK(check_map(map).mismatched_edges > 0);
  map.face_corners[3][1] = map.face_corners[3][0];
  CHECK(check_map(map).flipped_faces == 2);
  CHECK(check_map(map).first_flipped == 3);
  CHECK_FALSE(check_map(map).valid());
}

TEST_CASE("a vertex pulled over its neighbours flips faces, though edges match and areas sum up") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
  exact_maps::jitter(map, 1.5, 3, 3);
  const MapCheck check = check_map(map);
  CHECK(check.flipped_faces > 0);
  CHECK(check.mismatched_edges == 0);
  CHECK(check.area_error < 1e-12);
}

TEST_CASE("a face off by a lattice motion is fine, off by anything else is not") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 2);
  const Transition motion{4, {3, -2}};
  for (Complex& c : map.face_corners[10]) c = motion.apply(c);
  CHECK(check_map(map).mismatched_edges == 0);
  for (Complex& c : map.face_corners[10]) c += 1e-7;
  CHECK(check_map(map).mismatched_edges == 3);
  CHECK(check_map(map).misplaced_vertices == 3);
  for (Complex& c : map.face_corners[10]) c = (c - 1e-7) * std::polar(1.0, 0.1);
  CHECK(check_map(map).mismatched_edges == 3);
}

TEST_CASE("a sheet that covers a corner twice has positive areas and matching edges, and is caught") {
  // The surface is a fan of twelve triangles; the base a fan of six, so the map winds twice round the corner.
  Parameterization map = exact_maps::quadrisected(shapes::sector_disc(12, 0), 0);
  const Mesh half = shapes::sector_disc(6, 0);
  map.base.faces = half.faces;
  map.base.vertices.resize(half.positions.size());
  map.base.connect();
  for (int f = 0; f < 12; ++f) map.face_chart[f] %= 6;
  for (int& patch : map.patch) patch %= 6;
  const MapCheck check = check_map(map);
  CHECK(check.flipped_faces == 0);
  CHECK(check.wrong_angle_vertices > 0);
  CHECK(check.area_error == Approx(1.0));
  CHECK_FALSE(check.valid());
}

TEST_CASE("a corner given to the wrong vertex shows in the angles") {
  Parameterization map = exact_maps::quadrisected(shapes::tetrahedron(), 2);
  // A free vertex of valence 6 has 2π, a corner of the tetrahedron π.
  std::swap(map.base.vertices[0], map.base.vertices[1]);
  CHECK(check_map(map).wrong_angle_vertices == 0);
  CHECK(check_map(map).misplaced_vertices == 2);
  map.base.vertices[0] = map.surface.vertex_count() - 1;
  CHECK(check_map(map).wrong_angle_vertices == 2);
}

TEST_CASE("a boundary vertex off its line is caught") {
  Parameterization map = exact_maps::quadrisected(shapes::grid(1, 1), 2);
  const Halfedges halfedges(map.surface);
  int moved = -1;
  for (int v = 4; v < map.surface.vertex_count() && moved < 0; ++v)
    if (halfedges.boundary_vertex(v)) moved = v;
  const Complex to = map.position[moved] + Complex(0.01, 0.02);
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      if (map.surface.faces[f][k] == moved) map.face_corners[f][k] += to - map.position[moved];
  map.position[moved] = to;
  const MapCheck check = check_map(map);
  CHECK(check.mismatched_edges == 0);
  CHECK(check.wrong_angle_vertices > 0);
  CHECK(check.area_error > 1e-9);
}

TEST_CASE("positions are checked against patches and faces") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 2);
  const int v = map.surface.vertex_count() - 1;
  const Complex was = map.position[v];
  map.position[v] += Complex(1e-6, 0);
  CHECK(check_map(map).misplaced_vertices == 1);
  CHECK(check_map(map).first_misplaced == v);
  map.position[v] = was + Complex(2, 0);
  CHECK(check_map(map).misplaced_vertices == 1);
}

TEST_CASE("NaN is refused, never valid") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 1);
  map.face_corners[2][1] = {std::nan(""), 0.0};
  CHECK_THROWS_AS(check_map(map), Error);
}

TEST_CASE("isolated vertices need no patch, others do") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 1);
  map.surface.positions.push_back(Vec3(9, 9, 9));
  map.patch.push_back(-1);
  map.position.push_back({});
  CHECK(check_map(map).valid());
  map.patch[0] = -1;
  CHECK_THROWS_AS(check_map(map), Error);
}

TEST_CASE("arrays that do not fit together are refused") {
  const Parameterization good = exact_maps::quadrisected(shapes::octahedron(), 1);
  const auto refuses = [&](auto damage) {
    Parameterization map = good;
    damage(map);
    CHECK_THROWS_AS(check_map(map), Error);
  };
  refuses([](auto& m) { m.patch.pop_back(); });
  refuses([](auto& m) { m.face_corners.pop_back(); });
  refuses([](auto& m) { m.face_chart[0] = 8; });
  refuses([](auto& m) { m.face_chart[0] = -1; });
  refuses([](auto& m) { m.patch[0] = 8; });
  refuses([](auto& m) { m.surface.faces[1][1] = m.surface.vertex_count(); });
  refuses([](auto& m) { m.base.vertices[0] = -1; });
  refuses([](auto& m) { m.base.vertices[0] = m.base.vertices[1]; });
  refuses([](auto& m) { m.base.faces[0] = {0, 0, 1}; });
  refuses([](auto& m) { m.base.faces[0] = {0, 1, 6}; });
  refuses([](auto& m) { m.base.twins[0] = -1; });
  refuses([](auto& m) { m.base.twins.clear(); });
}

TEST_CASE("a star in the chart of another base face is torn off, though areas, angles and lattice motions hold") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 2);
  REQUIRE(check_map(map).torn_edges == 0);
  // A vertex whose whole star lies within its base face, and the faces around it, get another chart with the same
  // numbers.
  const int chart = 7;
  int inner = -1;
  for (int v = 0; v < map.surface.vertex_count() && inner < 0; ++v) {
    const auto w = chart_barycentric(map.position[v]);
    if (map.patch[v] != chart && std::min({w[0], w[1], w[2]}) > 0.2) inner = v;
  }
  REQUIRE(inner >= 0);
  map.patch[inner] = chart;
  int around = 0;
  for (int f = 0; f < map.surface.face_count(); ++f)
    if (std::count(map.surface.faces[f].begin(), map.surface.faces[f].end(), inner) > 0) {
      map.face_chart[f] = chart;
      ++around;
    }
  const MapCheck check = check_map(map);
  CHECK(check.flipped_faces == 0);
  CHECK(check.wrong_angle_vertices == 0);
  CHECK(check.misplaced_vertices == 0);
  CHECK(check.mismatched_edges == 0);
  CHECK(check.area_error < 1e-12);
  CHECK(check.torn_edges == around);
  CHECK_FALSE(check.valid());
}
