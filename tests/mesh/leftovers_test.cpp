#include <catch2/catch.hpp>
#include <string>

#include "mesh/io.h"
#include "mesh/ply.h"
#include "mesh/topology.h"
#include "mesh_files.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

/// What parsing ends in: the error's cause and place, or how many notes there are.
struct Reading {
  std::optional<Cause> cause;
  Element element = Element::None;
  long long index = -1;
  std::vector<std::string> notes;
};

Reading reading(MeshFormat format, const std::string& bytes) {
  try {
    return {{}, {}, -1, parse_surface(format, bytes).notes};
  } catch (const Error& error) {
    return {error.cause(), error.element(), error.index().value_or(-1), {}};
  }
}

void refused_on_line(MeshFormat format, const std::string& bytes, long long line) {
  INFO(bytes);
  const Reading found = reading(format, bytes);
  CHECK(found.cause == Cause::Malformed);
  CHECK(found.element == Element::Line);
  CHECK(found.index == line);
}

void read_with_notes(MeshFormat format, const std::string& bytes, std::size_t notes) {
  INFO(bytes);
  const Reading found = reading(format, bytes);
  CHECK_FALSE(found.cause.has_value());
  CHECK(found.notes.size() == notes);
}

std::string ascii_ply(const std::string& rows) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         rows;
}

std::string stl_file(int counted, int facets, const std::string& rest) {
  std::string bytes(84, '\0');
  bytes[80] = static_cast<char>(counted);
  std::string facet(50, '\0');
  facet[12 + 12 + 3] = facet[12 + 24 + 7] = '\x3f';  // corners 0 0 0, 0.5 0 0, 0 0.5 0
  for (int f = 0; f < facets; ++f) bytes += facet;
  return bytes + rest;
}

const std::string kMark = "\xef\xbb\xbf";

}  // namespace

TEST_CASE("OFF: what its counts and lines do not announce is refused with the line") {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n", off = "OFF\n3 1 0\n" + points;
  read_with_notes(MeshFormat::Off, off + "3 0 1 2\n \n# end\n", 0);
  refused_on_line(MeshFormat::Off, off + "3 0 1 2\n\n3 0 2 1\n", 8);
  refused_on_line(MeshFormat::Off, off + "3 0 1 2 0 1\n", 6);  // neither corners nor a colour
  refused_on_line(MeshFormat::Off, off + "3 0 1 2 1 1 1 1 1\n", 6);
  refused_on_line(MeshFormat::Off, off + "3 0 1 2 red\n", 6);
  refused_on_line(MeshFormat::Off, "OFF\n3 1 0\n0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n", 3);
  refused_on_line(MeshFormat::Off, "OFF\n3 1 0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 2);
  for (const char* colour : {"", " 5", " 255 0 0", " .1 .2 .3 .4"})
    read_with_notes(MeshFormat::Off, off + "3 0 1 2" + colour + "\n", 0);
  const auto vertices = [](const std::string& keyword, const std::string& tail) {
    return keyword + "\n3 1 0\n0 0 0" + tail + "\n1 0 0" + tail + "\n0 1 0" + tail + "\n3 0 1 2\n";
  };
  for (const char* tail : {" 1 1 1", " 9 9 9 9"}) read_with_notes(MeshFormat::Off, vertices("OFF", tail), 0);
  read_with_notes(MeshFormat::Off, vertices("NOFF", " 0 0 1"), 0);
  read_with_notes(MeshFormat::Off, vertices("CNOFF", " 0 0 1 1 1 1 1"), 0);
  read_with_notes(MeshFormat::Off, vertices("STCNOFF", " 0 0 1 1 1 1 .5 .5"), 0);
  refused_on_line(MeshFormat::Off, vertices("NOFF", " 0 0 1 2"), 3);
  refused_on_line(MeshFormat::Off, vertices("STOFF", " 1 1 1"), 3);
}

TEST_CASE("PLY: what its header does not announce is refused with the line or byte") {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  read_with_notes(MeshFormat::Ply, ascii_ply(points + "3\n0 1 2\n\n"), 0);  // a row may take several lines
  refused_on_line(MeshFormat::Ply, ascii_ply(points + "3 0 1 2 0\n"), 13);
  refused_on_line(MeshFormat::Ply, ascii_ply("0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n"), 10);
  refused_on_line(MeshFormat::Ply, ascii_ply("0 0 0 1 0 0 0 1 0\n3 0 1 2\n"), 10);
  refused_on_line(MeshFormat::Ply, ascii_ply(points + "3 0 1 2\n\n3 0 2 1\n"), 15);
  for (const MeshFile& file : square_files()) {
    if (std::string(file.name).find("endian") == std::string::npos) continue;
    INFO(file.name);
    read_with_notes(file.format, file.bytes + std::string("\n\0\0", 3), 1);  // the element `extra`
    const Reading found = reading(file.format, file.bytes + "more");
    CHECK(found.cause == Cause::Malformed);
    CHECK(found.element == Element::Byte);
    CHECK(found.index == static_cast<long long>(file.bytes.size()));
  }
}

TEST_CASE("STL: facets behind the count are refused with the byte, and text between facets with the line") {
  read_with_notes(MeshFormat::Stl, stl_file(2, 2, ""), 0);
  read_with_notes(MeshFormat::Stl, stl_file(2, 2, "padding"), 1);
  for (const int counted : {0, 1}) {
    const Reading found = reading(MeshFormat::Stl, stl_file(counted, 2, ""));
    CHECK(found.cause == Cause::Malformed);
    CHECK(found.element == Element::Byte);
    CHECK(found.index == 84 + 50 * counted);
  }
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  read_with_notes(MeshFormat::Stl, "solid a\n" + facet + "endsolid\n", 0);
  refused_on_line(MeshFormat::Stl, "solid a\nfacet normal 0 0 1\nendfacet\n" + facet + "endsolid\n", 3);
  refused_on_line(MeshFormat::Stl,
                  "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0 1\nvertex 1 0 0\nvertex 0 1 0\nendloop\n", 4);
}

TEST_CASE("OBJ: statements that are not read are noted, those like a vertex or face refused") {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  read_with_notes(MeshFormat::Obj, "mtllib a\no b\nvn 0 0 1\nvt 0 0\ns 1\ng c d\nusemtl e\n" + obj, 0);
  read_with_notes(MeshFormat::Obj, obj + "p 1\nl 1 2\nl 2 3\n", 2);
  read_with_notes(MeshFormat::Obj, obj + "curv 0 1 1 2\nsurf 0 1 0 1 1 2 3\n", 2);
  read_with_notes(MeshFormat::Obj, obj + "hello\nworld 1 2\n", 1);
  read_with_notes(MeshFormat::Obj, obj + "f 1 2\n", 1);
  for (const char* line : {"V 1 1 1", "F 1 2 3", "vertex 1 1 1", "face 1 2 3", "v1 1 1", "f1 2 3", "v-1 1 1",
                           "f1/1 2 3", "\xef\xbb\xbfv 1 1 1", "\x01v 1 1 1", "v: 1 1 1", "f, 1 2 3"})
    refused_on_line(MeshFormat::Obj, obj + line + "\n", 5);
  const SurfaceFile outline = parse_surface(MeshFormat::Obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n");
  CHECK(outline.mesh.face_count() == 1);
}

TEST_CASE("OBJ: a vertex's further numbers are a weight or a colour, or refused") {
  const auto vertex = [](const std::string& numbers) { return "v " + numbers + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"; };
  for (const char* numbers : {"0 0 0 1", "0 0 0 .1 .2 .3", "0 0 0 255 0 0 255"})
    read_with_notes(MeshFormat::Obj, vertex(numbers), 0);
  for (const char* numbers : {"0 0 0 0", "0 0 0 inf", "0 0 0 1 1", "0 0 0 1 1 1 1 1", "0 0 0 red"})
    refused_on_line(MeshFormat::Obj, vertex(numbers), 1);
  for (const char* corner : {"1/x", "1//x", "1/1/1/1", "1,2"})
    refused_on_line(MeshFormat::Obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 " + std::string(corner) + "\n", 4);
  const SurfaceFile weighted = parse_surface(MeshFormat::Obj, vertex("6 4 2 2"));
  CHECK(weighted.mesh.positions[0] == Vec3(3, 2, 1));
  CHECK(weighted.notes.size() == 1);
}

TEST_CASE("a byte order mark is no part of the text") {
  for (const MeshFile& file : square_files()) {
    if (std::string(file.name) == "binary STL") continue;
    INFO(file.name);
    const Mesh mesh = parse_surface(file.format, kMark + file.bytes).mesh;
    CHECK(mesh.positions == square().positions);
    CHECK(mesh.faces == square().faces);
  }
  CHECK(parse_ply(kMark + "ply\nformat ascii 1.0\nend_header\n").elements.empty());
  const std::string wide("\xff\xfev\0 \0", 6);
  CHECK(parse_cause(MeshFormat::Obj, wide) == Cause::UnknownFormat);
  CHECK(parse_cause(MeshFormat::Off, wide) == Cause::UnknownFormat);
}

TEST_CASE("faults: leftover data, marks and places of public reports") {
  const std::string root = shared_meshes();
  if (root.empty()) return;
  const auto refused = [&](const std::string& name, Cause cause, Element element, long long index) {
    INFO(name);
    try {
      const SurfaceFile file = read_surface(root + "/faults/" + name);
      try {
        require_parameterizable(file.mesh);
      } catch (const Error& error) {
        throw in_file(error, file.numbering);
      }
      FAIL_CHECK("no error");
    } catch (const Error& error) {
      CHECK(error.cause() == cause);
      CHECK(error.element() == element);
      CHECK(error.index() == index);
    }
  };
  refused("plyf_tail0.ply", Cause::Malformed, Element::Line, 138);
  refused("off_more_faces.off", Cause::Malformed, Element::Line, 259);
  refused("stl_count_small.stl", Cause::Malformed, Element::Byte, 84 + 50 * 288);
  refused("obj_zeroidx.obj", Cause::IndexOutOfRange, Element::Face, 1);
  refused("quadidx.obj", Cause::DegenerateFace, Element::Face, 3);
  CHECK(read_mesh(root + "/faults/off_bom.off").vertex_count() == 128);
  CHECK(topology_report(read_mesh(root + "/faults/off_bom.off")).boundary_loops == 0);
  const Mesh shifted = read_mesh(root + "/faults/bom_shift.obj");
  CHECK(shifted.positions[0] == Vec3(2.7, 0, 0));
  CHECK(topology_report(shifted).boundary_loops == 0);
  const SurfaceFile weighted = read_surface(root + "/faults/obj_w2.obj");
  CHECK(weighted.notes.size() == 1);
  CHECK(weighted.mesh.positions[0] == Vec3(2.7, 0, 0));
}

TEST_CASE("places follow the file: polygons as it counts them, from 1 in OBJ") {
  const auto refusal = [](MeshFormat format, const std::string& bytes) {
    const SurfaceFile file = parse_surface(format, bytes);
    const TopologyReport report = topology_report(file.mesh);
    REQUIRE(report.refusal.has_value());
    return in_file(*report.refusal, file.numbering);
  };
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 1 2\n";
  CHECK(refusal(MeshFormat::Obj, obj + "f 2 5 6 3\nf 5 6 6\n").index() == 4);
  CHECK(refusal(MeshFormat::Obj, obj + "f 2 3 5\n").index() == 2);
  const Error edge = refusal(MeshFormat::Obj, obj + "f 2 3 5\n");
  CHECK(edge.cause() == Cause::InconsistentOrientation);
  CHECK(edge.place()->end == 3);
  CHECK(std::string(edge.what()).find("the edge of vertices 2 and 3") != std::string::npos);
  CHECK(refusal(MeshFormat::Obj, "v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").index() == 1);
  CHECK(refusal(MeshFormat::Off, "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 1 2 3\n3 2 4 4\n").index() == 1);
  // The facets of an STL are welded; its vertices are counted as its lines have them.
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::string bad =
      "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 nan 0\nvertex 0 1 0\nendloop\nendfacet\n";
  CHECK(refusal(MeshFormat::Stl, "solid\n" + facet + bad + "endsolid\n").index() == 4);
}
