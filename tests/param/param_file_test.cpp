#include "param/map/param_file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "cause_of.h"
#include "mesh/error.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// A file in the system's temporary folder, removed at the end of the test.
struct TemporaryFile {
  std::string path =
      (std::filesystem::temp_directory_path() / ("gsp-param-" + std::to_string(::getpid()) + ".param.ply")).string();
  ~TemporaryFile() { std::filesystem::remove(path); }

  std::string bytes() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }
};

Parameterization sample() {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 1);
  exact_maps::jitter(map, 0.19, 1, 4);
  map.surface.positions.push_back(Vec3(1, 2, 3));
  map.patch.push_back(-1);
  map.position.push_back({});
  map.provenance = {"method gsp", "gamma 2", "note with\na line break"};
  return map;
}

Cause refusal(const std::string& path) {
  try {
    read_parameterization(path);
  } catch (const Error& e) {
    return e.cause();
  }
  return Cause::Internal;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("what is written is read back: surface, charts and base to the bit, positions to rounding") {
  const TemporaryFile file;
  const Parameterization map = sample();
  write_parameterization(file.path, map);
  const Parameterization back = read_parameterization(file.path);
  CHECK(back.surface.positions == map.surface.positions);
  CHECK(back.surface.faces == map.surface.faces);
  CHECK(back.patch == map.patch);
  CHECK(back.face_chart == map.face_chart);
  CHECK(back.face_corners == map.face_corners);
  CHECK(back.base.vertices == map.base.vertices);
  CHECK(back.base.faces == map.base.faces);
  CHECK(back.base.twins == map.base.twins);
  CHECK(back.provenance == std::vector<std::string>{"method gsp", "gamma 2", "note with a line break"});
  for (std::size_t v = 0; v < map.position.size(); ++v) CHECK(std::abs(back.position[v] - map.position[v]) < 1e-15);
  CHECK(check_map(back).valid());
}

TEST_CASE("the header is the documented one") {
  const TemporaryFile file;
  Parameterization map = exact_maps::quadrisected(shapes::tetrahedron(), 0);
  map.provenance = {"method gsp"};
  write_parameterization(file.path, map);
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment gsp parameterization 1\ncomment method gsp\n"
      "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty int patch\n"
      "property double u\nproperty double v\n"
      "element face 4\nproperty list uchar int vertex_indices\nproperty int chart\nproperty list uchar double "
      "texcoord\n"
      "element base_vertex 4\nproperty int vertex\n"
      "element base_face 4\nproperty list uchar int base_vertex_indices\nend_header\n";
  const std::string bytes = file.bytes();
  CHECK(bytes.substr(0, header.size()) == header);
  CHECK(bytes.size() == header.size() + 4 * 44 + 4 * 66 + 4 * 4 + 4 * 13);
}

TEST_CASE("creases are written behind the base, and read back") {
  const TemporaryFile file;
  Parameterization map = exact_maps::quadrisected(shapes::tetrahedron(), 0);
  write_parameterization(file.path, map);
  const std::string plain = file.bytes();
  map.base.creases = {{0, 1}, {1, 3}};
  write_parameterization(file.path, map);
  const std::string bytes = file.bytes(), declared = "element crease 2\nproperty int first\nproperty int second\n";
  CHECK(bytes.find(declared + "end_header\n") != std::string::npos);
  CHECK(bytes.size() == plain.size() + declared.size() + 2 * 8);
  CHECK(read_parameterization(file.path).base.creases == map.base.creases);
  const std::vector<char> on_crease = map.base.crease_halfedges();
  CHECK(std::count(on_crease.begin(), on_crease.end(), 1) == 4);
  file.write(bytes.substr(0, bytes.size() - 1));
  CHECK(refusal(file.path) == Cause::Truncated);
}

TEST_CASE("every truncation is a named error") {
  const TemporaryFile file;
  write_parameterization(file.path, exact_maps::quadrisected(shapes::tetrahedron(), 0));
  const std::string whole = file.bytes();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    file.write(whole.substr(0, length));
    const Cause cause = refusal(file.path);
    CHECK((cause == Cause::Truncated || cause == Cause::Malformed));
  }
  file.write(whole + "x");
  CHECK(refusal(file.path) == Cause::Malformed);
}

TEST_CASE("altered bytes give a map or a named error") {
  const TemporaryFile file;
  write_parameterization(file.path, sample());
  const std::string whole = file.bytes();
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = whole;
    for (int changes = 1 + static_cast<int>(random.next() % 3); changes > 0; --changes)
      bytes[random.next() % bytes.size()] = static_cast<char>(random.next());
    file.write(bytes);
    try {
      check_map(read_parameterization(file.path));
    } catch (const Error& e) {
      CHECK(exit_status(e.cause()) == 3);
    }
  }
}

TEST_CASE("hostile headers take no memory and are refused by name") {
  const TemporaryFile file;
  write_parameterization(file.path, sample());
  const std::string whole = file.bytes();
  const auto cause = [&](const std::string& from, const std::string& to) {
    file.write(replaced(whole, from, to));
    return refusal(file.path);
  };
  CHECK(cause("element vertex 19", "element vertex 700000000") == Cause::Truncated);
  CHECK(cause("element vertex 19", "element vertex 99999999999999999999") == Cause::Malformed);
  CHECK(cause("element vertex 19", "element vertex -1") == Cause::Malformed);
  CHECK(cause("element vertex 19", "element vertex 19x") == Cause::Malformed);
  CHECK(cause("element face 32", "element face 2147483647") == Cause::Malformed);
  CHECK(cause("element base_face 8", "element base_face 9") == Cause::Truncated);
  CHECK(cause("binary_little_endian", "ascii") == Cause::Malformed);
  CHECK(cause("property int chart\n", "") == Cause::Malformed);
  CHECK(cause("comment gsp parameterization 1\n", "") == Cause::Malformed);
  CHECK(cause("ply", "PLY") == Cause::Malformed);
  CHECK(cause("comment method gsp\n", "comment\n") == Cause::Internal);
  CHECK(refusal(file.path + ".absent") == Cause::CannotOpen);
  CHECK(refusal(std::filesystem::temp_directory_path().string()) == Cause::CannotOpen);
}

TEST_CASE("a file's indices and values that do not fit are refused by name") {
  const TemporaryFile file;
  const Parameterization map = sample();
  write_parameterization(file.path, map);
  const std::string whole = file.bytes();
  const auto cause = [&](const auto& from, const auto& to) {
    static_assert(sizeof from == sizeof to);
    const auto bytes = [](const auto& value) {
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    file.write(replaced(whole, bytes(from), bytes(to)));
    return refusal(file.path);
  };
  const Triangle face = map.surface.faces[0];
  CHECK(cause(face, Triangle{19, face[1], face[2]}) == Cause::IndexOutOfRange);
  CHECK(cause(face, Triangle{-1, face[1], face[2]}) == Cause::IndexOutOfRange);
  const Vec3 point = map.surface.positions[1];
  CHECK(cause(point, Vec3(point.x(), std::nan(""), point.z())) == Cause::NonFinite);
  CHECK(cause(point, Vec3(point.x(), 1e200, point.z())) == Cause::NonFinite);
}

TEST_CASE("a map's indices and values that do not fit are refused by name before they are written") {
  const TemporaryFile file;
  const auto cause = [&](auto damage) {
    Parameterization map = sample();
    damage(map);
    return cause_of([&] { write_parameterization(file.path, map); });
  };
  CHECK(cause([](auto& m) { m.surface.faces[0][0] = 19; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.surface.faces[0][0] = -1; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.face_chart[3] = 8; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.patch[0] = -2; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.patch[0] = -1; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.base.vertices[2] = 50; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.base.faces[2][0] = 6; }) == Cause::IndexOutOfRange);
  CHECK(cause([](auto& m) { m.base.faces[2] = {1, 1, 2}; }) == Cause::Malformed);
  CHECK(cause([](auto& m) { m.base.creases = {{0, 6}}; }) == Cause::Malformed);
  CHECK(cause([](auto& m) { m.base.creases = {{-1, 2}}; }) == Cause::Malformed);
  CHECK(cause([](auto& m) { m.base.creases = {{0, 1}}; }) == Cause::Malformed);  // opposite corners
  CHECK(cause([](auto& m) { m.base.creases = {{2, 0}}; }) == Cause::Malformed);
  CHECK(cause([](auto& m) { m.base.creases = {{0, 2}, {0, 2}}; }) == Cause::Malformed);
  CHECK(cause([](auto& m) { m.base.creases = {{0, 3}, {0, 2}}; }) == Cause::Malformed);
  CHECK(cause([](auto& m) { m.surface.positions[1].y() = std::nan(""); }) == Cause::NonFinite);
  CHECK(cause([](auto& m) { m.surface.positions[1].y() = 1e200; }) == Cause::NonFinite);
  CHECK(cause([](auto& m) { m.position[1] = {INFINITY, 0}; }) == Cause::NonFinite);
  CHECK(cause([](auto& m) { m.face_corners[1][2] = {0, -INFINITY}; }) == Cause::NonFinite);
}
