#include "mesh_files.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

using namespace gsp;

namespace {

/// Appends a number's bytes, the machine being little-endian.
template <typename T>
void put(std::string& bytes, T value, bool big_endian = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

/// Extra properties and elements around those that matter, which a reader must step over.
std::string binary_ply(bool big_endian) {
  std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                      "_endian 1.0\ncomment a square\nobj_info none\nelement vertex 4\nproperty uint8 red\n"
                      "property float64 x\nproperty float32 y\nproperty int16 z\nelement extra 2\n"
                      "property list ushort float numbers\nelement face 1\nproperty list uint8 int32 vertex_indices\n"
                      "property uchar flags\nend_header\n";
  for (const Vec3& p : square().positions) {
    put<std::uint8_t>(bytes, 200);
    put<double>(bytes, p.x(), big_endian);
    put<float>(bytes, static_cast<float>(p.y()), big_endian);
    put<std::int16_t>(bytes, static_cast<std::int16_t>(p.z()), big_endian);
  }
  put<std::uint16_t>(bytes, 0, big_endian);
  put<std::uint16_t>(bytes, 2, big_endian);
  put<float>(bytes, 1.5f, big_endian);
  put<float>(bytes, 2.5f, big_endian);
  put<std::uint8_t>(bytes, 4);
  for (int v = 0; v < 4; ++v) put<std::int32_t>(bytes, v, big_endian);
  put<std::uint8_t>(bytes, 7);
  return bytes;
}

std::string strip_ply() {
  return "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
         "element tristrips 1\r\nproperty list int int vertex_indices\r\nend_header\r\n"
         "0 0 -3\r\n1 0 -3\r\n1 1 -3\r\n0 1 -3\r\n7 0 1 2 -1 0 2 3\r\n";
}

std::string binary_stl() {
  std::string bytes = "solid, but binary";
  bytes.resize(80, ' ');
  put<std::uint32_t>(bytes, 2);
  const Mesh mesh = square();
  for (const Triangle& t : mesh.faces) {
    for (int k = 0; k < 3; ++k) put<float>(bytes, 0.0f);
    for (int v : t)
      for (int k = 0; k < 3; ++k) put<float>(bytes, static_cast<float>(mesh.positions[v][k]));
    put<std::uint16_t>(bytes, 0);
  }
  return bytes;
}

}  // namespace

Mesh square() { return {{{0, 0, -3}, {1, 0, -3}, {1, 1, -3}, {0, 1, -3}}, {{0, 1, 2}, {0, 2, 3}}}; }

std::vector<MeshFile> square_files() {
  return {
      {"ASCII PLY", MeshFormat::Ply,
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
       "property uchar red\nelement face 2\nproperty list uchar uint vertex_index\nend_header\n"
       "0 0 -3 1\n1e0 +0 -3 2\n1 1.0 -3 3\n-0 1 -.3e1 4\n3 0 1 2\n3 0 2 3\n"},
      {"little-endian PLY", MeshFormat::Ply, binary_ply(false)},
      {"big-endian PLY", MeshFormat::Ply, binary_ply(true)},
      {"PLY of strips, CR LF", MeshFormat::Ply, strip_ply()},
      {"OBJ", MeshFormat::Obj,
       "# square\nmtllib none.mtl\no thing\nv 0 0 -3\nv  1.0 0 -3 1.0\nvn 0 0 1\nvt 0 0\ng a b\ns off\nusemtl red # x\n"
       "f 1/1/1 2//1 \\\n 3/1\nv 1 1 -3 0.5 0.5 0.5\nv 0 1 -3\nl 1 2\nf -4 -2 -1\nf 1 2\n"},
      {"OBJ, CR LF", MeshFormat::Obj, "v 0 0 -3\r\nv 1\t0 -3\r\nv 1 1 -3\r\nv 0 1 -3\r\n\r\nf 1 2 3 4\r\n"},
      {"OFF", MeshFormat::Off, "OFF\n# a square\n4 1 0\n0 0 -3\n1 0 -3 # here\n\n1 1 -3\n0 1 -3\n4 0 1 2 3 255 0 0\n"},
      {"OFF, coloured, CR LF, tabs", MeshFormat::Off,
       "\tCOFF\r\n4\t2\t0\r\n0 0 -3 1 1 1 1\r\n1 0 -3 0 0 0 1\r\n1 1 -3 0 0 0 1\r\n0 1 -3 0 0 0 1\r\n3 0 1 2\r\n\r\n"
       "3\t0\t2\t3\r\n"},
      {"OFF without keyword or edges", MeshFormat::Off, "4 2\n0 0 -3\n1 0 -3\n1 1 -3\n0 1 -3\n3 0 1 2\n3 0 2 3"},
      {"OFF, all on one header line", MeshFormat::Off, "OFF4 2 0\n0 0 -3\n1 0 -3\n1 1 -3\n0 1 -3\n3 0 1 2\n3 0 2 3"},
      {"binary STL", MeshFormat::Stl, binary_stl()},
      {"ASCII STL", MeshFormat::Stl,
       "solid a square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 -3\nvertex 1 0 -3\nvertex 1 1 -3\nendloop\n"
       "endfacet\nendsolid a square\nSOLID\n FACET NORMAL nan(ind) ? ?\n  OUTER LOOP\n   VERTEX -0 0 -3\n"
       "   VERTEX 1 1 -3\n   VERTEX 0 1 -3\n  ENDLOOP\n ENDFACET\nENDSOLID\n"},
  };
}

std::optional<Cause> parse_cause(MeshFormat format, std::string_view bytes) {
  try {
    parse_surface(format, bytes);
  } catch (const Error& error) {
    return error.cause();
  }
  return std::nullopt;
}
