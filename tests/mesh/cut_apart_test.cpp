#include "mesh/cut_apart.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "mesh/features/cut.h"
#include "mesh/io.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "mesh/weld.h"
#include "temporary_folder.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

/// The faces with vertices renamed: of[v] is the new name of v.
Mesh renamed(Mesh mesh, const std::vector<std::pair<int, int>>& names) {
  for (Triangle& t : mesh.faces)
    for (int& v : t)
      for (const auto& [from, to] : names)
        if (v == from) v = to;
  return mesh;
}

/// Pages about the z axis from 0 to 1, each of two faces, that share its edge from vertex 0 to vertex 1.
Mesh book(int pages) {
  Mesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}};
  for (int page = 0; page < pages; ++page) {
    const double angle = 2.0 * 3.14 * page / pages, x = std::cos(angle), y = std::sin(angle);
    mesh.positions.push_back({x, y, 0});
    mesh.positions.push_back({x, y, 1});
    const int low = mesh.vertex_count() - 2;
    mesh.faces.push_back({0, low, low + 1});
    mesh.faces.push_back({0, low + 1, 1});
  }
  return mesh;
}

/// Cut apart, after a look at what holds for every surface.
CutApart cut_of(const Mesh& mesh) {
  CutApart cut = cut_apart(mesh);
  const Mesh& open = cut.surface.mesh;
  const TopologyReport before = topology_report(mesh), after = topology_report(open);
  CHECK(after.non_manifold_edges.empty());
  CHECK(after.non_manifold_vertices.empty());
  CHECK(after.misoriented_edges.empty());
  CHECK(cut.counts.edges == static_cast<int>(before.non_manifold_edges.size() + before.misoriented_edges.size()));
  CHECK(cut.counts.vertices >= static_cast<int>(before.non_manifold_vertices.size()));
  CHECK(cut.counts.added_vertices == open.vertex_count() - mesh.vertex_count());
  // The same triangles at the same places: the same area, the same set of points.
  CHECK(glue(cut.surface).positions == mesh.positions);
  CHECK(glue(cut.surface).faces == mesh.faces);
  CHECK(surface_area(open) == surface_area(mesh));
  for (int v = 0; v < open.vertex_count(); ++v)
    CHECK((open.positions[v].array() == mesh.positions[cut.surface.original[v]].array()).all());
  // Nothing is left to cut.
  const CutApart again = cut_apart(open);
  CHECK(again.counts.edges + again.counts.vertices + again.counts.added_vertices == 0);
  CHECK(again.surface.mesh.faces == open.faces);
  return cut;
}

}  // namespace

TEST_CASE("a manifold is not cut") {
  for (const Mesh& mesh : {shapes::torus(9, 7), shapes::grid(4, 3), shapes::twice(shapes::tetrahedron(), {9, 0, 0})}) {
    const CutApart cut = cut_of(mesh);
    CHECK(cut.counts.added_vertices == 0);
    CHECK(cut.surface.mesh.faces == mesh.faces);
    CHECK(cut.surface.mesh.positions == mesh.positions);
  }
}

TEST_CASE("tetrahedra that share a vertex or an edge are two again, without a boundary") {
  const Mesh two = shapes::twice(shapes::tetrahedron(), {3, 0, 0});
  const CutApart vertex = cut_of(renamed(two, {{4, 0}}));
  CHECK(vertex.counts.edges == 0);
  CHECK(vertex.counts.vertices == 1);
  CHECK(vertex.counts.added_vertices == 1);
  CHECK(vertex.surface.original.back() == 0);
  const CutApart edge = cut_of(renamed(two, {{4, 0}, {5, 1}}));
  CHECK(edge.counts.edges == 1);
  CHECK(edge.counts.vertices == 2);
  CHECK(edge.counts.added_vertices == 2);
  for (const CutApart& cut : {vertex, edge}) {
    const TopologyReport report = topology_report(cut.surface.mesh);
    CHECK(report.usable());
    CHECK(report.components.size() == 2);
    CHECK(report.boundary_edges == 0);
  }
}

TEST_CASE("the pages of a book come apart, and a fin comes off a surface that stays whole") {
  for (int pages : {3, 4, 7}) {
    const CutApart cut = cut_of(book(pages));
    CHECK(cut.counts.edges == 1);
    CHECK(cut.counts.vertices == 2);
    CHECK(cut.counts.added_vertices == 2 * (pages - 1));
    const TopologyReport report = topology_report(cut.surface.mesh);
    CHECK(report.usable());
    CHECK(report.components.size() == static_cast<std::size_t>(pages));
    CHECK(report.boundary_edges == 4 * pages);
  }
  // A wall on a floor, along a line from boundary to boundary: nothing says which two of the three sheets are one.
  const Mesh wall = renamed(shapes::twice(shapes::grid(4, 2), {2, 0, 0}), {{15, 2}, {20, 7}, {25, 12}});
  CHECK(topology_report(cut_of(wall).surface.mesh).components.size() == 3);
  // A fin on an edge inside a grid: its two ends become two vertices each, and the grid has no hole.
  Mesh grid = shapes::grid(4, 4);
  const int boundary = topology_report(grid).boundary_edges;
  grid.positions.push_back({2, 2, 1});
  grid.faces.push_back({12, 13, 25});
  const CutApart cut = cut_of(grid);
  CHECK(cut.counts.edges == 1);
  CHECK(cut.counts.added_vertices == 2);
  const TopologyReport report = topology_report(cut.surface.mesh);
  CHECK(report.components.size() == 2);
  CHECK(report.boundary_edges == boundary + 3);
}

TEST_CASE("a surface that touches itself in a point or along an edge comes free of itself") {
  const Mesh sphere = shapes::sphere(2);
  const CutApart point = cut_of(renamed(sphere, {{3, 0}}));
  CHECK(point.counts.vertices == 1);
  CHECK(topology_report(point.surface.mesh).components[0].genus == 0);
  // Two columns of edges of a grid, far apart and off its boundary, become one.
  const Mesh grid = shapes::grid(9, 4);
  const CutApart edge = cut_of(renamed(grid, {{16, 12}, {26, 22}, {36, 32}}));
  CHECK(edge.counts.edges == 2);
  CHECK(edge.counts.vertices == 3);
  const TopologyReport report = topology_report(edge.surface.mesh);
  CHECK(report.components.size() == 1);
  CHECK(report.boundary_edges == topology_report(grid).boundary_edges);
}

TEST_CASE("faces that disagree come apart: a Moebius strip is a strip, a turned patch is a piece of its own") {
  Mesh strip = shapes::grid(8, 1);
  const CutApart moebius = cut_of(renamed(strip, {{8, 9}, {17, 0}}));
  CHECK(moebius.counts.edges == 1);
  CHECK(topology_report(moebius.surface.mesh).usable());
  CHECK(topology_report(moebius.surface.mesh).boundary_loops == 1);
  Mesh torus = shapes::torus(8, 8);
  std::swap(torus.faces[20][0], torus.faces[20][1]);
  const CutApart patch = cut_of(torus);
  CHECK(patch.counts.edges == 3);
  CHECK(topology_report(patch.surface.mesh).components.size() == 2);
  CHECK(topology_report(patch.surface.mesh).usable());
}

TEST_CASE("triangles at random become manifolds whatever they were") {
  Random random(16);
  for (int round = 0; round < 200; ++round) {
    Mesh mesh;
    for (int v = 0; v < 9; ++v) mesh.positions.push_back({random.uniform(), random.uniform(), random.uniform()});
    const auto vertex = [&] { return std::min(8, static_cast<int>(9.0 * random.uniform())); };
    for (int f = 0; f < 4 + round % 40; ++f) {
      Triangle t;
      for (int& v : t) v = vertex();
      mesh.faces.push_back(t);  // some name a vertex twice
    }
    cut_of(mesh);
  }
  CHECK_THROWS_AS(cut_apart({{{0, 0, 0}}, {{0, 1, 2}}}), Error);
}

TEST_CASE("a surface is read cut apart, and places still follow the file") {
  const TemporaryFolder folder;
  const std::string path = folder.file("book.obj");
  Mesh mesh = book(3);
  mesh.positions.push_back(Vec3::Constant(0.5));
  write_mesh(path, mesh);
  CHECK_FALSE(topology_report(read_surface(path).mesh).usable());
  const SurfaceFile file = read_surface(path, {.repair = Repair::Cut});
  CHECK(topology_report(file.mesh).usable());
  REQUIRE(file.cuts);
  CHECK(file.cuts->edges == 1);
  CHECK(file.notes.size() == 1);
  const Error error = in_file(Error(Cause::NonFinite, "", Element::Vertex, mesh.vertex_count() + 1), file.numbering);
  CHECK(error.index() == 2);  // a copy of the second vertex of the file, which counts from 1

  // Boxes that share an edge by its places only: the weld joins them, and the cut comes after it.
  const Mesh boxes = shapes::twice(shapes::box(2), {1, 1, 0});
  write_mesh(folder.file("boxes.ply"), boxes);
  const SurfaceFile welded = read_surface(folder.file("boxes.ply"), {.weld = 0.0, .repair = Repair::Cut});
  CHECK(welded.cuts->edges == 4);
  CHECK(welded.cuts->vertices == 5);
  CHECK(welded.mesh.vertex_count() == boxes.vertex_count());
  CHECK(topology_report(welded.mesh).boundary_edges == 0);

  write_mesh(folder.file("sphere.ply"), shapes::sphere(1));
  const SurfaceFile plain = read_surface(folder.file("sphere.ply")),
                    cut = read_surface(folder.file("sphere.ply"), {.repair = Repair::Cut});
  CHECK(cut.mesh.positions == plain.mesh.positions);
  CHECK(cut.mesh.faces == plain.mesh.faces);
  for (Repair repair : kRepairs) CHECK(repair_of(repair_name(repair)) == repair);
  CHECK_THROWS_AS(repair_of("mend"), Error);
}
