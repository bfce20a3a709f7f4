#include "mesh/io.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include "mesh/ply.h"
#include "mesh/random.h"
#include "mesh/read_file.h"
#include "mesh/shapes.h"
#include "mesh_files.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

/// A surface whose coordinates use all 53 bits and a wide range of exponents.
Mesh awkward_surface() {
  Mesh mesh = shapes::torus(7, 5);
  Random random(1);
  for (Vec3& p : mesh.positions)
    for (int k = 0; k < 3; ++k) p[k] = (random.uniform() - 0.5) * std::pow(10.0, 40.0 * random.uniform() - 20.0);
  mesh.positions[0] = {1.0 / 3.0, std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::max()};
  mesh.positions[1] = {-0.0, 5e-324, 0.1};
  return mesh;
}

Cause read_cause(const std::string& path) {
  try {
    read_mesh(path);
  } catch (const Error& error) {
    return error.cause();
  }
  FAIL("no error");
  return Cause::Internal;
}

}  // namespace

TEST_CASE("every dialect of every format gives the same square") {
  for (const MeshFile& file : square_files()) {
    INFO(file.name);
    const Mesh mesh = parse_surface(file.format, file.bytes).mesh;
    CHECK(mesh.positions == square().positions);
    CHECK(mesh.faces == square().faces);
  }
}

TEST_CASE("PLY, OBJ and OFF return every coordinate bit for bit") {
  const TemporaryFolder folder;
  const Mesh mesh = awkward_surface();
  for (const char* name : {"a.ply", "a.obj", "a.OFF"}) {
    INFO(name);
    write_mesh(folder.file(name), mesh, {"first comment", "of two\nlines"});
    const Mesh back = read_mesh(folder.file(name));
    CHECK(back.faces == mesh.faces);
    REQUIRE(back.vertex_count() == mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      for (int k = 0; k < 3; ++k) {
        REQUIRE(back.positions[v][k] == mesh.positions[v][k]);
        REQUIRE(std::signbit(back.positions[v][k]) == std::signbit(mesh.positions[v][k]));
      }
  }
}

TEST_CASE("STL returns the welded surface in single precision") {
  const TemporaryFolder folder;
  const Mesh mesh = shapes::sphere(2);
  write_mesh(folder.file("a.stl"), mesh);
  CHECK(std::filesystem::file_size(folder.file("a.stl")) == 84 + 50 * mesh.faces.size());
  const Mesh back = read_mesh(folder.file("a.stl"));
  REQUIRE(back.vertex_count() == mesh.vertex_count());
  REQUIRE(back.face_count() == mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      CHECK(back.positions[back.faces[f][k]] == mesh.positions[mesh.faces[f][k]].cast<float>().cast<double>());
}

TEST_CASE("STL refuses what single precision cannot hold, and leaves no file") {
  const TemporaryFolder folder;
  Mesh mesh = shapes::tetrahedron();
  mesh.positions[2].y() = 1e39;
  CHECK_THROWS_AS(write_mesh(folder.file("a.stl"), mesh), Error);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("written PLY has the header that any viewer opens") {
  const TemporaryFolder folder;
  write_mesh(folder.file("a.ply"), shapes::tetrahedron(), {"by gsp"});
  const std::string bytes = read_file(folder.file("a.ply"));
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment by gsp\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(bytes.substr(0, header.size()) == header);
  CHECK(bytes.size() == header.size() + 4 * 24 + 4 * 13);
}

TEST_CASE("the file's ending decides, and missing or wrong files are named") {
  const TemporaryFolder folder;
  CHECK(read_cause(folder.file("none.ply")) == Cause::CannotOpen);
  CHECK(read_cause(folder.file("none.xyz")) == Cause::UnknownFormat);
  CHECK(read_cause(folder.file("none")) == Cause::UnknownFormat);
  std::filesystem::create_directories(folder.file("folder.ply"));
  CHECK(read_cause(folder.file("folder.ply")) == Cause::CannotOpen);
  CHECK_THROWS_AS(write_mesh(folder.file("a.xyz"), square()), Error);
  try {
    write_mesh(folder.file("no/such/a.ply"), square());
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::CannotWrite);
  }
}

TEST_CASE("an error names the file and the line or face") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.off");
  std::ofstream(path) << "OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n";
  try {
    read_mesh(path);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::Malformed);
    CHECK(error.element() == Element::Line);
    CHECK(error.index() == 4);
    CHECK(std::string(error.what()) == path + ": \"x\" is not a number (line 4)");
  }
  std::ofstream(path) << "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n";
  try {
    read_mesh(path);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::IndexOutOfRange);
    CHECK(error.element() == Element::Face);
    CHECK(error.index() == 1);
  }
}

TEST_CASE("polygons become fans from their first corner, and those of fewer than three corners nothing") {
  const Mesh mesh =
      parse_surface(MeshFormat::Off, "OFF\n5 4 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 4 0 1 2 3\n2 0 1\n0\n3 0 1 2")
          .mesh;
  CHECK(mesh.faces == std::vector<Triangle>{{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {0, 1, 2}});
}

TEST_CASE("numbers that are not finite are kept for the report") {
  const Mesh mesh =
      parse_surface(MeshFormat::Off, "OFF\n3 1 0\nnan -inf 1e999\nNaN Infinity -1e999\n1e-999 0 0\n3 0 1 2\n").mesh;
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(std::isnan(mesh.positions[0].x()));
  CHECK(mesh.positions[0].y() == -infinity);
  CHECK(mesh.positions[0].z() == infinity);
  CHECK(mesh.positions[1].z() == -infinity);
  CHECK(mesh.positions[2].x() == 0.0);
}

TEST_CASE("vertex order and isolated vertices are the file's") {
  const Mesh mesh = parse_surface(MeshFormat::Obj, "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 2 3 4\n").mesh;
  CHECK(mesh.vertex_count() == 5);
  CHECK(mesh.faces == std::vector<Triangle>{{1, 2, 3}});
}

TEST_CASE("a PLY document comes back as it was written") {
  PlyDocument document;
  document.comments = {"one", "", "two words"};
  PlyElement element{"thing", 2, {}};
  const auto scalar = [](const char* name, PlyType type, double a, double b) {
    PlyProperty p;
    p.name = name;
    p.type = type;
    p.values = {a, b};
    return p;
  };
  element.properties = {scalar("a", PlyType::Int8, -128, 127),
                        scalar("b", PlyType::Uint8, 0, 255),
                        scalar("c", PlyType::Int16, -32768, 32767),
                        scalar("d", PlyType::Uint16, 0, 65535),
                        scalar("e", PlyType::Int32, -2147483648.0, 2147483647.0),
                        scalar("f", PlyType::Uint32, 0, 4294967295.0),
                        scalar("g", PlyType::Float32, 0.5, -1e30f),
                        scalar("h", PlyType::Float64, std::numbers::pi, 5e-324)};
  PlyProperty list;
  list.name = "list";
  list.count_type = PlyType::Uint16;
  list.values = {1.25, 2.5, -3.75};
  list.starts = {0, 0, 3};
  element.properties.push_back(list);
  document.elements = {element, {"nothing", 3, {}}};

  std::ostringstream out;
  write_ply(out, document);
  const PlyDocument back = parse_ply(out.str());
  CHECK(back.comments == document.comments);
  REQUIRE(back.elements.size() == 2);
  CHECK(back.elements[1].count == 3);
  REQUIRE(back.elements[0].properties.size() == element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty &was = element.properties[i], &is = back.elements[0].properties[i];
    CHECK(is.name == was.name);
    CHECK(is.type == was.type);
    CHECK(is.count_type == was.count_type);
    CHECK(is.values == was.values);
    CHECK(is.starts == was.starts);
  }
  CHECK(back.find("thing")->list("list") != nullptr);
  CHECK(back.find("thing")->scalar("list") == nullptr);
  CHECK(back.find("none") == nullptr);
}
