#include <catch2/catch.hpp>
#include <string>

#include "mesh/random.h"
#include "mesh/topology.h"
#include "mesh_files.h"

using namespace gsp;

namespace {

/// Reads and reports, both of which must end in a result or an Error whatever the bytes are.
void survive(MeshFormat format, std::string_view bytes) {
  try {
    topology_report(parse_surface(format, bytes).mesh);
  } catch (const Error& error) {
    REQUIRE(exit_status(error.cause()) == 3);
  }
}

/// Replaces, removes, repeats or inserts a few bytes, some of them chosen to hurt.
std::string mutated(std::string bytes, Random& random) {
  static constexpr std::string_view spice = "0123456789-+.eE#\\/ \n\r\t\"\0\xff";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.next() % n); };
  for (std::size_t edits = 1 + below(4); edits > 0 && !bytes.empty(); --edits) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random.next());
        break;
      case 1:
        bytes[at] = spice[below(spice.size())];
        break;
      case 2:
        bytes.erase(at, 1 + below(8));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(30)));
        break;
      case 4:
        bytes.insert(at, 1, spice[below(spice.size())]);
        break;
      case 5:
        bytes.insert(at, "99999999999999999999", 1 + below(20));
        break;
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("a file cut at any byte is read or refused") {
  for (const MeshFile& file : square_files()) {
    INFO(file.name);
    for (std::size_t length = 0; length < file.bytes.size(); ++length)
      survive(file.format, std::string_view(file.bytes).substr(0, length));
  }
}

TEST_CASE("a binary file cut anywhere is refused as truncated") {
  for (const MeshFile& file : square_files()) {
    const bool stl = std::string_view(file.name) == "binary STL";
    if (!stl && std::string_view(file.name) != "big-endian PLY") continue;
    // Under 84 bytes an STL that begins with "solid" is taken for text, and is malformed.
    for (std::size_t length = stl ? 84 : 0; length < file.bytes.size(); ++length) {
      INFO(file.name << " cut at " << length);
      REQUIRE(parse_cause(file.format, std::string_view(file.bytes).substr(0, length)).has_value());
    }
  }
}

TEST_CASE("damaged files never crash the readers") {
  Random random(20030727);
  for (const MeshFile& file : square_files())
    for (int trial = 0; trial < 3000; ++trial) survive(file.format, mutated(file.bytes, random));
}

TEST_CASE("a count that lies is refused before memory is taken") {
  const auto ply = [](const std::string& vertices, const std::string& faces, const std::string& format) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uint int vertex_indices\nend_header\n";
  };
  const std::string huge = "9000000000000000000";
  for (const char* format : {"ascii", "binary_little_endian"}) {
    CHECK(parse_cause(MeshFormat::Ply, ply(huge, "0", format)) == Cause::Truncated);
    CHECK(parse_cause(MeshFormat::Ply, ply("0", huge, format)) == Cause::Truncated);
    CHECK(parse_cause(MeshFormat::Ply, ply("0", "99999999999999999999", format)) == Cause::Malformed);
    CHECK(parse_cause(MeshFormat::Ply, ply("-1", "0", format)) == Cause::Malformed);
  }
  CHECK(parse_cause(MeshFormat::Ply, ply("0", "1", "ascii") + "4000000000 0 1 2\n") == Cause::Truncated);
  CHECK(parse_cause(MeshFormat::Ply, ply("0", "1", "binary_little_endian") + "\xff\xff\xff\xff____") ==
        Cause::Truncated);
  CHECK(parse_cause(MeshFormat::Off, "OFF\n" + huge + " 6 0\n0 0 0\n") == Cause::Truncated);
  CHECK(parse_cause(MeshFormat::Off, "OFF\n1 " + huge + " 0\n0 0 0\n") == Cause::Truncated);
  CHECK(parse_cause(MeshFormat::Off, "OFF\n1 1 0\n0 0 0\n" + huge + " 0 0 0\n") == Cause::Truncated);
  std::string stl(84, '\0');
  stl[83] = '\x7f';
  CHECK(parse_cause(MeshFormat::Stl, stl) == Cause::Truncated);
  const std::string no_properties = "ply\nformat ascii 1.0\nelement vertex " + huge + "\nend_header\n";
  CHECK(parse_cause(MeshFormat::Ply, no_properties) == Cause::Malformed);
}

TEST_CASE("what a format forbids is malformed") {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\n";
  const std::string list = "property list char int vertex_indices\nend_header\n", points = "0 0 0\n1 0 0\n0 1 0\n";
  const auto ply = [](const std::string& bytes) { return parse_cause(MeshFormat::Ply, bytes); };
  CHECK(ply(header + list + points + "3 0 1 2\n") == std::nullopt);
  CHECK(ply(header + list + points + "-3 0 1 2\n") == Cause::Malformed);
  CHECK(ply(header + list + points + "3 0 1.5 2\n") == Cause::Malformed);
  CHECK(ply(header + list + points + "3 0 1 3\n") == Cause::IndexOutOfRange);
  CHECK(ply(header + list + points + "3 0 1 4294967296\n") == Cause::IndexOutOfRange);
  CHECK(ply(header + "property list float int vertex_indices\nend_header\n" + points) == Cause::Malformed);
  CHECK(ply(header + "property list uchar int corners\nend_header\n" + points + "3 0 1 2\n") == Cause::Malformed);
  CHECK(ply(header + "propperty list uchar int vertex_indices\nend_header\n" + points) == Cause::Malformed);
  CHECK(ply("ply\nelement vertex 0\nend_header\n") == Cause::Malformed);
  CHECK(ply("ply\nformat ascii 2.0\nend_header\n") == Cause::Malformed);
  CHECK(ply("ply\nformat ascii 1.0\nend_header\n") == Cause::Malformed);
  CHECK(ply("solid\n") == Cause::Malformed);
  CHECK(ply("") == Cause::Truncated);

  const auto obj = [](const std::string& bytes) { return parse_cause(MeshFormat::Obj, bytes); };
  CHECK(obj("") == std::nullopt);
  CHECK(obj("v 0 0\n") == Cause::Malformed);
  CHECK(obj("v 0 0 0\nf a b c\n") == Cause::Malformed);
  CHECK(obj("v 0 0 0\nf 0 1 1\n") == Cause::IndexOutOfRange);
  CHECK(obj("v 0 0 0\nf 1 1 -2\n") == Cause::IndexOutOfRange);
  CHECK(obj("v 0 0 0\nf 1 1 99999999999999999999\n") == Cause::Malformed);

  const auto off = [](const std::string& bytes) { return parse_cause(MeshFormat::Off, bytes); };
  CHECK(off("") == Cause::Truncated);
  CHECK(off("OFF BINARY\n") == Cause::UnknownFormat);
  CHECK(off("4OFF\n1 0 0\n0 0 0 1\n") == Cause::UnknownFormat);
  CHECK(off("OFF\n-1 0 0\n") == Cause::Malformed);
  CHECK(off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n") == Cause::Malformed);
  CHECK(off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n") == Cause::IndexOutOfRange);

  const auto stl = [](const std::string& bytes) { return parse_cause(MeshFormat::Stl, bytes); };
  CHECK(stl("") == Cause::Truncated);
  CHECK(stl("solid nothing\nendsolid\n") == std::nullopt);
  CHECK(stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n") == Cause::Malformed);
  CHECK(stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0") == Cause::Truncated);
  CHECK(stl("hello\n") == Cause::Malformed);
}
