#include "mesh/shapes.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/halfedges.h"

using namespace gsp;

namespace {

struct Counts {
  int vertices, edges, faces, boundary_edges;
};

/// Counts with sets, apart from `Halfedges`, and checks that every directed edge occurs once.
Counts count(const Mesh& mesh) {
  std::set<std::pair<int, int>> directed;
  for (const Triangle& t : mesh.faces)
    for (int k = 0; k < 3; ++k) REQUIRE(directed.emplace(t[k], t[(k + 1) % 3]).second);
  int boundary = 0;
  for (const auto& [a, b] : directed) boundary += !directed.count({b, a});
  return {mesh.vertex_count(), static_cast<int>(directed.size() + boundary) / 2, mesh.face_count(), boundary};
}

int euler(const Counts& c) { return c.vertices - c.edges + c.faces; }

/// Positive where a closed surface is oriented outward.
double enclosed_volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.faces)
    sum += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])) / 6.0;
  return sum;
}

void require_upward(const Mesh& mesh) {
  for (const Triangle& t : mesh.faces) {
    const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]], b = mesh.positions[t[2]] - mesh.positions[t[0]];
    REQUIRE(a.cross(b).z() > 0.0);
  }
}

}  // namespace

TEST_CASE("platonic shapes have their counts, areas and volumes") {
  const auto check = [](const Mesh& mesh, int v, int f, double area, double volume) {
    const Counts c = count(mesh);
    CHECK(c.vertices == v);
    CHECK(c.faces == f);
    CHECK(euler(c) == 2);
    CHECK(c.boundary_edges == 0);
    CHECK(surface_area(mesh) == Approx(area).epsilon(1e-14));
    CHECK(enclosed_volume(mesh) == Approx(volume).epsilon(1e-14));
  };
  const double s3 = std::numbers::sqrt3, s5 = std::sqrt(5.0);
  check(shapes::tetrahedron(), 4, 4, s3 * 8.0, 8.0 / 3.0);
  check(shapes::octahedron(), 6, 8, 2.0 * s3 * 2.0, 4.0 / 3.0);
  const double edge = 1.0 / std::sin(2.0 * std::numbers::pi / 5.0);
  check(shapes::icosahedron(), 12, 20, 5.0 * s3 * edge * edge, 5.0 / 12.0 * (3.0 + s5) * edge * edge * edge);
}

TEST_CASE("sphere tends to the sphere") {
  const Mesh mesh = shapes::sphere(4, 3.0);
  CHECK(mesh.face_count() == 20 * 256);
  CHECK(euler(count(mesh)) == 2);
  for (const Vec3& p : mesh.positions) CHECK(p.norm() == Approx(3.0).epsilon(1e-14));
  CHECK(surface_area(mesh) == Approx(4.0 * std::numbers::pi * 9.0).epsilon(3e-3));
  CHECK(enclosed_volume(mesh) == Approx(4.0 / 3.0 * std::numbers::pi * 27.0).epsilon(5e-3));
  CHECK(bounding_box_diagonal(mesh) <= 6.0 * std::numbers::sqrt3);
}

TEST_CASE("tori have valence 6 everywhere, Euler characteristic 0, and tend to the torus") {
  const Mesh mesh = shapes::torus(200, 100, 2.0, 0.5);
  CHECK(euler(count(mesh)) == 0);
  const double pi = std::numbers::pi;
  CHECK(surface_area(mesh) == Approx(4.0 * pi * pi * 2.0 * 0.5).epsilon(1e-3));
  CHECK(enclosed_volume(mesh) == Approx(2.0 * pi * pi * 2.0 * 0.25).epsilon(2e-3));

  const Mesh lattice = shapes::lattice_torus(5, 4);
  CHECK(lattice.vertex_count() == 20);
  CHECK(lattice.face_count() == 40);
  CHECK(euler(count(lattice)) == 0);
  std::vector<int> valence(20, 0);
  for (const Triangle& t : lattice.faces)
    for (int v : t) ++valence[v];
  for (int v : valence) CHECK(v == 6);
  CHECK(count(shapes::lattice_torus(3, 3)).edges == 27);
}

TEST_CASE("grid is flat, of area m n, at its height") {
  const Mesh mesh = shapes::grid(7, 3, 2.5);
  const Counts c = count(mesh);
  CHECK(c.vertices == 32);
  CHECK(c.faces == 42);
  CHECK(c.boundary_edges == 20);
  CHECK(euler(c) == 1);
  CHECK(surface_area(mesh) == Approx(21.0));
  require_upward(mesh);
  CHECK(mesh.positions[2 * 8 + 3] == Vec3(3, 2, 2.5));
}

TEST_CASE("sector disc has one centre of the given valence") {
  for (int sectors : {3, 4, 5, 6, 7, 12}) {
    const Mesh mesh = shapes::sector_disc(sectors, 2);
    const Counts c = count(mesh);
    CHECK(c.faces == sectors * 16);
    CHECK(c.boundary_edges == sectors * 4);
    CHECK(euler(c) == 1);
    require_upward(mesh);
    const Halfedges he(mesh);
    int valence = 0;
    for (int h = he.outgoing[0], first = h; valence == 0 || h != first; h = he.rotate_ccw(h)) ++valence;
    CHECK(valence == sectors);
  }
  CHECK(surface_area(shapes::sector_disc(6, 3)) == Approx(6.0 * std::numbers::sqrt3 / 4.0).epsilon(1e-14));
}

TEST_CASE("genus slab has its genus at every level") {
  for (int genus = 0; genus <= 3; ++genus)
    for (int level = 0; level <= 2; ++level) {
      const Mesh mesh = shapes::genus_slab(genus, level);
      const Counts c = count(mesh);
      CHECK(c.boundary_edges == 0);
      CHECK(euler(c) == 2 - 2 * genus);
      CHECK(enclosed_volume(mesh) > 0.0);
      for (int f = 0; f < c.faces; ++f) REQUIRE(face_area(mesh, f) > 0.0);
    }
}

TEST_CASE("quadrisect keeps the surface and numbers vertices and faces as documented") {
  const Mesh coarse = shapes::grid(2, 1);
  const Mesh fine = shapes::quadrisect(coarse);
  const Counts c = count(coarse), d = count(fine);
  CHECK(d.vertices == c.vertices + c.edges);
  CHECK(d.faces == 4 * c.faces);
  CHECK(surface_area(fine) == Approx(surface_area(coarse)));
  for (int v = 0; v < c.vertices; ++v) CHECK(fine.positions[v] == coarse.positions[v]);
  const auto& t = coarse.faces[0];
  CHECK(fine.faces[0] == Triangle{t[0], 6, 8});
  CHECK(fine.faces[3] == Triangle{6, 7, 8});
  CHECK(fine.positions[6] == 0.5 * (coarse.positions[t[0]] + coarse.positions[t[1]]));
}

TEST_CASE("twice doubles everything") {
  const Mesh mesh = shapes::twice(shapes::octahedron(), {3, 0, 0});
  CHECK(mesh.vertex_count() == 12);
  CHECK(mesh.face_count() == 16);
  CHECK(euler(count(mesh)) == 4);
  CHECK(mesh.positions[6] == Vec3(4, 0, 0));
}
