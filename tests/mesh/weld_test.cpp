#include "mesh/weld.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "mesh/io.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "temporary_folder.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

/// Every corner a vertex of its own, moved by at most `jitter` in each coordinate.
Mesh soup_of(const Mesh& mesh, double jitter) {
  Random random(18);
  Mesh soup;
  for (const Triangle& t : mesh.faces) {
    for (int v : t) {
      Vec3 p = mesh.positions[v];
      for (int k = 0; k < 3; ++k) p[k] += jitter * (2.0 * random.uniform() - 1.0);
      soup.positions.push_back(p);
    }
    const int last = soup.vertex_count() - 1;
    soup.faces.push_back({last - 2, last - 1, last});
  }
  return soup;
}

/// The rule of `first_within`, by looking at all that were kept.
std::vector<int> first_within_by_force(const std::vector<Vec3>& positions, double distance) {
  std::vector<int> kept, first;
  for (int v = 0; v < static_cast<int>(positions.size()); ++v) {
    const auto near =
        std::find_if(kept.begin(), kept.end(), [&](int k) { return (positions[k] - positions[v]).norm() <= distance; });
    first.push_back(near == kept.end() ? v : *near);
    if (near == kept.end()) kept.push_back(v);
  }
  return first;
}

}  // namespace

TEST_CASE("positions within a distance become the first of them that was kept") {
  Random random(5);
  for (const double size : {1.0, 1e-40, 1e40}) {
    std::vector<Vec3> positions;
    for (int i = 0; i < 1500; ++i) {
      const auto at = [&] { return size * (random.uniform() - 0.5); };
      const double x = at(), y = at(), z = at();
      positions.push_back({x, y, z});
    }
    for (const double share : {0.3, 0.05, 0.01, 1e-5}) {
      const std::vector<int> first = first_within(positions, share * size);
      CHECK(first == first_within_by_force(positions, share * size));
    }
  }
}

TEST_CASE("a weld leaves alone what is not finite, and takes lattices whose points lie just the distance apart") {
  std::vector<Vec3> positions;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) positions.push_back({0.25 * i, 0.25 * j, 0});
  positions.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  positions.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  positions.push_back({1e308, 0, 0});
  for (const double distance : {0.25, 0.5, 0.2})
    CHECK(first_within(positions, distance) == first_within_by_force(positions, distance));
}

TEST_CASE("a weld makes a surface of its triangles again") {
  for (const Mesh& mesh : {shapes::torus(12, 8), shapes::sphere(3)}) {
    for (const double jitter : {0.0, 1e-8}) {
      const Mesh soup = soup_of(mesh, jitter);
      CHECK(topology_report(soup).boundary_edges == 3 * mesh.face_count());
      const WeldedMesh welded = weld(soup, jitter == 0.0 ? 0.0 : 1e-7);
      const TopologyReport report = topology_report(welded.mesh);
      CHECK(report.usable());
      CHECK(report.vertices == mesh.vertex_count());
      CHECK(report.boundary_edges == 0);
      for (std::size_t v = 0; v < welded.vertices.size(); ++v)
        CHECK(welded.mesh.positions[v] == soup.positions[welded.vertices[v]]);
    }
  }
}

TEST_CASE("a weld drops faces without three corners, and places still follow the file") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.off");
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}, {0, 1, 0}, {0, 1, 1}}, {{0, 1, 2}, {0, 2, 3}, {3, 4, 0}, {0, 2, 4}}};
  mesh.positions.push_back({0, 0, 0});
  mesh.faces.push_back({5, 1, 4});
  write_mesh(path, mesh);
  const SurfaceFile whole = read_surface(path), file = read_surface(path, {.weld = 1e-6});
  CHECK(whole.mesh.face_count() == 5);
  CHECK(whole.notes.empty());
  CHECK(file.mesh.vertex_count() == 4);
  REQUIRE(file.mesh.faces == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}, {0, 1, 3}, {0, 1, 3}});
  CHECK(file.notes.size() == 1);
  CHECK(file.numbering.vertices == std::vector<int>{0, 1, 3, 4});
  const Error refusal = in_file(topology_report(file.mesh).refusal.value(), file.numbering);
  CHECK(refusal.cause() == Cause::DuplicateFace);
  CHECK(refusal.index() == 4);
  CHECK(read_surface(path, {.weld = 0.0}).mesh.vertex_count() == 5);
}

TEST_CASE("faults: split surfaces of public reports are welded on request") {
  const std::string root = shared_meshes();
  if (root.empty()) return;
  const std::string stl = root + "/faults/stl_jitter1e-7.stl";
  CHECK(topology_report(read_mesh(stl)).components.size() == 576);
  const TopologyReport torus = topology_report(read_surface(stl, {.weld = 1e-6}).mesh);
  CHECK(torus.usable());
  CHECK(torus.vertices == 288);
  CHECK(torus.boundary_edges == 0);
  REQUIRE(torus.components.size() == 1);
  CHECK(torus.components[0].genus == 1);
  const std::string player = root + "/variety/basketball_player_20692.obj";
  const TopologyReport split = topology_report(read_mesh(player));
  const TopologyReport whole = topology_report(read_surface(player, {.weld = 0.0}).mesh);
  CHECK(split.vertices - whole.vertices == 938);
  CHECK(split.components.size() == 16);
  CHECK(whole.components.size() == 1);
  CHECK(whole.boundary_edges < split.boundary_edges);
}
