#include "mesh/halfedges.h"

#include <catch2/catch.hpp>

#include "mesh/shapes.h"

using namespace gsp;

TEST_CASE("twins run the other way, and every fan is walked once from its first half-edge") {
  for (const Mesh& mesh : {shapes::genus_slab(2, 1), shapes::sector_disc(5, 2), shapes::grid(1, 1)}) {
    const Halfedges he(mesh);
    int boundary = 0;
    for (int h = 0; h < 3 * mesh.face_count(); ++h) {
      const int t = he.twin[h];
      boundary += t < 0;
      if (t < 0) continue;
      REQUIRE(he.twin[t] == h);
      REQUIRE(he.from(t) == he.to(h));
      REQUIRE(he.to(t) == he.from(h));
    }
    std::vector<int> valence(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.faces)
      for (int v : t) ++valence[v];
    int boundary_vertices = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      boundary_vertices += he.boundary_vertex(v);
      int walked = 0;
      int h = he.outgoing[v];
      do {
        REQUIRE(he.from(h) == v);
        ++walked;
        h = he.rotate_ccw(h);
      } while (h >= 0 && h != he.outgoing[v]);
      CHECK(walked == valence[v]);
      CHECK((h < 0) == he.boundary_vertex(v));
    }
    CHECK(boundary == boundary_vertices);
  }
}

TEST_CASE("an isolated vertex has no half-edge") {
  Mesh mesh = shapes::octahedron();
  mesh.positions.emplace_back(9, 9, 9);
  const Halfedges he(mesh);
  CHECK(he.outgoing[6] == -1);
  CHECK_FALSE(he.boundary_vertex(6));
}
