#include "mesh/io.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <ostream>
#include <utility>

#include <Eigen/Geometry>

#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/files/formats.h"
#include "mesh/ply_elements.h"
#include "mesh/read_file.h"
#include "mesh/topology.h"
#include "mesh/words.h"

namespace gsp {

namespace {

MeshFormat require_format(const std::string& path) {
  const std::optional<MeshFormat> format = format_of(path);
  if (!format)
    throw Error(Cause::UnknownFormat,
                path + " does not end in .ply, .obj, .off or .stl, the surface formats known here");
  return *format;
}

void write_ply_mesh(std::ostream& out, const Mesh& mesh, const std::vector<std::string>& comments) {
  write_ply(out, {comments, {ply_vertices(mesh), ply_faces(mesh)}});
}

/// Appends the shortest decimal that reads back as the same number.
template <typename Number>
void append(std::string& line, Number number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  line.append(digits.data(), end);
}

void write_text_comments(std::ostream& out, const std::vector<std::string>& comments) {
  for (std::string comment : comments) {
    for (char& c : comment)
      if (c == '\n' || c == '\r') c = ' ';
    out << "# " << comment << '\n';
  }
}

/// Vertices and faces as OBJ and OFF have them: words before each line, and the number of the first vertex.
void write_text(std::ostream& out, const Mesh& mesh, const char* vertex, const char* face, int first_index) {
  std::string line;
  for (const Vec3& p : mesh.positions) {
    line = vertex;
    for (int k = 0; k < 3; ++k) {
      if (k > 0) line += ' ';
      append(line, p[k]);
    }
    out << line << '\n';
  }
  for (const Triangle& t : mesh.faces) {
    line = face;
    for (int k = 0; k < 3; ++k) {
      if (k > 0) line += ' ';
      append(line, t[k] + first_index);
    }
    out << line << '\n';
  }
}

void write_obj(std::ostream& out, const Mesh& mesh, const std::vector<std::string>& comments) {
  write_text_comments(out, comments);
  write_text(out, mesh, "v ", "f ", 1);
}

void write_off(std::ostream& out, const Mesh& mesh, const std::vector<std::string>& comments) {
  out << "OFF\n";
  write_text_comments(out, comments);
  out << mesh.vertex_count() << ' ' << mesh.face_count() << " 0\n";
  write_text(out, mesh, "", "3 ", 0);
}

void write_stl(std::ostream& out, const Mesh& mesh) {
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.positions[v].cwiseAbs().maxCoeff() > std::numeric_limits<float>::max())
      throw Error(Cause::CannotWrite, "a coordinate is too large for STL's single precision", Element::Vertex, v);
  // The header must not begin with "solid", by which readers tell the ASCII kind.
  std::string header = "binary STL by gsp";
  header.resize(80);
  out << header;
  const auto count = static_cast<std::uint32_t>(mesh.face_count());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const Triangle& t : mesh.faces) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Vec3 normal = (b - a).cross(c - a).stableNormalized();
    std::array<float, 12> values;
    for (int k = 0; k < 3; ++k) {
      values[k] = static_cast<float>(normal[k]);
      values[3 + k] = static_cast<float>(a[k]);
      values[6 + k] = static_cast<float>(b[k]);
      values[9 + k] = static_cast<float>(c[k]);
    }
    out.write(reinterpret_cast<const char*>(values.data()), sizeof values);
    const std::uint16_t attributes = 0;
    out.write(reinterpret_cast<const char*>(&attributes), sizeof attributes);
  }
}

}  // namespace

const char* repair_name(Repair repair) { return repair == Repair::Cut ? "cut" : "none"; }

Repair repair_of(const std::string& name) { return value_of(kRepairs, repair_name, name, "repair"); }

SurfaceFile read_surface(const std::string& path, const ReadOptions& options) {
  const MeshFormat format = require_format(path);
  const std::string bytes = read_file(path);
  try {
    SurfaceFile file = parse_surface(format, bytes);
    if (options.weld) weld(file, *options.weld);
    if (options.repair == Repair::Cut) cut_apart(file);
    return file;
  } catch (const Error& error) {
    throw error.within(path);
  }
}

Mesh read_mesh(const std::string& path) { return read_surface(path).mesh; }

void write_mesh(const std::string& path, const Mesh& mesh, const std::vector<std::string>& comments) {
  const MeshFormat format = require_format(path);
  require_indices(mesh);
  AtomicFile file(path);
  std::ostream& out = file.stream();
  switch (format) {
    case MeshFormat::Ply:
      write_ply_mesh(out, mesh, comments);
      break;
    case MeshFormat::Obj:
      write_obj(out, mesh, comments);
      break;
    case MeshFormat::Off:
      write_off(out, mesh, comments);
      break;
    case MeshFormat::Stl:
      write_stl(out, mesh);
      break;
  }
  file.commit();
}

}  // namespace gsp
