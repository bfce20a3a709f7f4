#include "remesh/semiregular_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "mesh/error.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "remesh/recover_levels.h"
#include "tests/cause_of.h"

using namespace gsp;

namespace {

/// Midpoint quadrisections of a plain mesh.
SemiregularMesh flat_refinement(const Mesh& base, int level) {
  SemiregularMesh mesh;
  mesh.level = level;
  mesh.base_vertices = base.vertex_count();
  mesh.base_faces = base.faces;
  mesh.positions = base.positions;
  const std::vector<SubdivisionLevel> levels = subdivision_levels(mesh.base_vertices, mesh.base_faces, level);
  for (int l = 0; l < level; ++l)
    for (const auto& [a, b] : levels[l].edges) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
  return mesh;
}

std::string temporary(const char* name) { return (std::filesystem::temp_directory_path() / name).string(); }

}  // namespace

TEST_CASE("a semi-regular file comes back bit for bit, and a changed one is refused") {
  const std::string path = temporary("gsp_semiregular_test.sr.ply");
  const SemiregularMesh mesh = flat_refinement(shapes::icosahedron(), 2);
  write_semiregular(path, mesh, {"positions fitted"});
  const SemiregularMesh back = read_semiregular(path);
  CHECK(back.level == 2);
  CHECK(back.base_vertices == 12);
  CHECK(back.base_faces == mesh.base_faces);
  CHECK(back.positions == mesh.positions);

  const Mesh plain = mesh.mesh();
  write_mesh(path, plain);
  CHECK(cause_of([&] { read_semiregular(path); }) == Cause::NoSubdivisionConnectivity);
  const auto with = [&](const Mesh& m, const char* level, const char* vertices, const char* faces) {
    write_mesh(path, m, {"gsp semiregular 1", level, vertices, faces});
    return cause_of([&] { read_semiregular(path); });
  };
  CHECK(with(plain, "level 3", "base_vertices 12", "base_faces 20") == Cause::NoSubdivisionConnectivity);
  CHECK(with(plain, "level -1", "base_vertices 12", "base_faces 20") == Cause::NoSubdivisionConnectivity);
  CHECK(with(plain, "level 2", "base_vertices 2000000000", "base_faces 20") == Cause::NoSubdivisionConnectivity);
  CHECK(with(plain, "level 1", "base_vertices 12", "base_faces 80") == Cause::NoSubdivisionConnectivity);
  Mesh swapped = plain;
  std::swap(swapped.faces[5], swapped.faces[6]);
  CHECK(with(swapped, "level 2", "base_vertices 12", "base_faces 20") == Cause::NoSubdivisionConnectivity);
  std::filesystem::remove(path);
}

TEST_CASE(
    "creases come back with a semi-regular file, and those that are no base edges are refused before they are "
    "written") {
  const std::string path = temporary("gsp_semiregular_creases_test.sr.ply");
  SemiregularMesh mesh = flat_refinement(shapes::icosahedron(), 1);
  for (const auto& [a, b] : {mesh.levels()[0].edges[0], mesh.levels()[0].edges[7]})
    mesh.creases.push_back({std::min(a, b), std::max(a, b)});
  std::sort(mesh.creases.begin(), mesh.creases.end());
  write_semiregular(path, mesh);
  const SemiregularMesh back = read_semiregular(path);
  CHECK(back.creases == mesh.creases);
  CHECK(back.positions == mesh.positions);
  CHECK(read_mesh(path).faces == mesh.mesh().faces);

  const auto with = [&](const Creases& creases) {
    mesh.creases = creases;
    return cause_of([&] { write_semiregular(path, mesh); });
  };
  const auto [a, b] = mesh.creases[0];
  CHECK(with({{a, b}, {a, b}}) == Cause::Malformed);
  CHECK(with({{b, a}}) == Cause::Malformed);
  CHECK(with({{0, 1000}}) == Cause::Malformed);
  CHECK(with({{-1, 0}}) == Cause::Malformed);

  mesh.creases.clear();
  const std::vector<SubdivisionLevel> levels = mesh.levels();
  for (const auto& ends : levels[0].edges)
    if (std::min(ends[0], ends[1]) == 0 && mesh.creases.size() < 2)
      mesh.creases.push_back({0, std::max(ends[0], ends[1])});
  std::sort(mesh.creases.begin(), mesh.creases.end());
  mesh.corners = {0};
  write_semiregular(path, mesh);
  CHECK(read_semiregular(path).corners == mesh.corners);
  mesh.corners = {mesh.creases[0][1]};
  CHECK(cause_of([&] { write_semiregular(path, mesh); }) == Cause::Malformed);
  std::filesystem::remove(path);
}
