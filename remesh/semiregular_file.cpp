#include "remesh/semiregular_file.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/io.h"
#include "mesh/ply_elements.h"
#include "remesh/filters/displacement.h"

namespace gsp {

namespace {

struct Counts {
  std::optional<int> level, base_vertices, base_faces;
  int creases = 0;
  std::optional<double> control_grid;
};

/// What the PLY header's comments say; nothing where the signature is missing.
std::optional<Counts> read_counts(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  Counts counts;
  bool signed_by_us = false;
  // A header longer than this is none of ours; without a limit a binary file would be searched to its end for a
  // newline.
  constexpr int kHeaderLines = 200;
  std::string line;
  for (int n = 0; n < kHeaderLines && std::getline(in, line) && line.rfind("end_header", 0) != 0; ++n) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line == std::string("comment ") + kSemiregularSignature) signed_by_us = true;
    std::istringstream words(line);
    std::string comment, key;
    if (!(words >> comment >> key) || comment != "comment") continue;
    if (key == "control_grid") {
      double grid = 0.0;
      if (words >> grid) counts.control_grid = grid;
      continue;
    }
    int value = 0;
    if (!(words >> value)) continue;
    if (key == "level") counts.level = value;
    if (key == "base_vertices") counts.base_vertices = value;
    if (key == "base_faces") counts.base_faces = value;
    if (key == "creases") counts.creases = value;
  }
  return signed_by_us ? std::optional<Counts>(counts) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(Cause::NoSubdivisionConnectivity, path + ": " + why);
}

/// Base face f, found again at the finest level: child k of a face keeps corner k in place k.
Triangle base_face(const std::vector<Triangle>& faces, int level, std::int64_t f) {
  Triangle t;
  for (int k = 0; k < 3; ++k) {
    std::int64_t child = f;
    for (int l = 0; l < level; ++l) child = 4 * child + k;
    t[k] = faces[child][k];
  }
  return t;
}

PlyProperty numbers(const std::string& name) { return {name, PlyType::Float64, {}, {}, {}}; }

PlyElement ply_control(const ControlMesh& control) {
  PlyElement element{"control", control.points.size(), {numbers("x"), numbers("y"), numbers("z")}};
  for (const Vec3& p : control.points)
    for (int k = 0; k < 3; ++k) element.properties[k].values.push_back(p[k]);
  return element;
}

constexpr const char* kCorner = "base_vertex";
constexpr std::array<const char*, 2> kCreaseEnds = {"base_vertex_0", "base_vertex_1"};

PlyElement ply_corners(const std::vector<int>& corners) {
  return {"crease_corner",
          corners.size(),
          {{kCorner, PlyType::Int32, {}, std::vector<double>(corners.begin(), corners.end()), {}}}};
}

PlyElement ply_creases(const Creases& creases) {
  PlyElement element{"crease", creases.size(), {}};
  for (int k = 0; k < 2; ++k) {
    element.properties.push_back({kCreaseEnds[k], PlyType::Int32, {}, {}, {}});
    for (const auto& ends : creases) element.properties[k].values.push_back(ends[k]);
  }
  return element;
}

/// One column of indices of vertices. That they are what they should be is for `base_level` to check.
std::vector<int> read_vertices(const std::string& path, const PlyElement& element, const char* name) {
  const PlyProperty* property = element.scalar(name);
  if (!property) throw Error(Cause::Malformed, path + ": creases without " + name);
  std::vector<int> vertices;
  for (double v : property->values) {
    if (!(v >= 0.0 && v <= std::numeric_limits<int>::max()))
      throw Error(Cause::Malformed, path + ": a crease ends at no vertex");
    vertices.push_back(static_cast<int>(v));
  }
  return vertices;
}

Creases read_creases(const std::string& path, const PlyDocument& document, int count) {
  const PlyElement* element = document.find("crease");
  if (!element || element->count != static_cast<std::size_t>(count))
    throw Error(Cause::Malformed,
                path + ": the comments name " + std::to_string(count) + " creases, not as many as are there");
  Creases creases(element->count);
  for (int k = 0; k < 2; ++k) {
    const std::vector<int> ends = read_vertices(path, *element, kCreaseEnds[k]);
    for (std::size_t i = 0; i < creases.size(); ++i) creases[i][k] = ends[i];
  }
  return creases;
}

ControlMesh read_control(const std::string& path, const PlyDocument& document, double grid) {
  const PlyElement* element = document.find("control");
  ControlMesh control{{}, grid};
  if (!element) throw Error(Cause::Malformed, path + ": no element 'control'");
  control.points.resize(element->count);
  int k = 0;
  for (const char* name : {"x", "y", "z"}) {
    const PlyProperty* property = element->scalar(name);
    if (!property) throw Error(Cause::Malformed, path + ": control points without " + name);
    for (std::size_t b = 0; b < element->count; ++b) control.points[b][k] = property->values[b];
    ++k;
  }
  return control;
}

void write_with_elements(const std::string& path, const SemiregularMesh& mesh, std::vector<std::string> comments) {
  const Mesh plain = mesh.mesh();
  PlyElement vertices = ply_vertices(plain);
  std::vector<PlyElement> more;
  if (!mesh.creases.empty()) {
    comments.push_back("creases " + std::to_string(mesh.creases.size()));
    more.push_back(ply_creases(mesh.creases));
    if (!mesh.corners.empty()) more.push_back(ply_corners(mesh.corners));
  }
  if (mesh.control) {
    std::ostringstream grid;
    grid.precision(17);
    grid << "control_grid " << mesh.control->grid;
    comments.push_back(grid.str());
    vertices.properties.push_back(numbers("displacement"));
    vertices.properties.back().values = displaced_form(mesh).displacements.along;
    more.push_back(ply_control(*mesh.control));
  }
  std::vector<PlyElement> elements = {std::move(vertices), ply_faces(plain)};
  elements.insert(elements.end(), more.begin(), more.end());
  AtomicFile file(path);
  write_ply(file.stream(), {std::move(comments), std::move(elements)});
  file.commit();
}

}  // namespace

void write_semiregular(const std::string& path, const SemiregularMesh& mesh,
                       const std::vector<std::string>& provenance) {
  std::vector<std::string> comments = {kSemiregularSignature, "level " + std::to_string(mesh.level),
                                       "base_vertices " + std::to_string(mesh.base_vertices),
                                       "base_faces " + std::to_string(mesh.base_faces.size())};
  comments.insert(comments.end(), provenance.begin(), provenance.end());
  if (mesh.control || !mesh.creases.empty())
    write_with_elements(path, mesh, std::move(comments));
  else
    write_mesh(path, mesh.mesh(), comments);
}

SemiregularMesh read_semiregular(const std::string& path) {
  const Mesh plain = read_mesh(path);
  const std::optional<Counts> counts = read_counts(path);
  if (!counts || !counts->level || !counts->base_vertices || !counts->base_faces)
    refuse(path, std::string("no comments '") + kSemiregularSignature + "', 'level', 'base_vertices' and 'base_faces'");
  SemiregularMesh mesh;
  mesh.level = *counts->level;
  mesh.base_vertices = *counts->base_vertices;
  if (mesh.level < 0 || mesh.level > kMaxSubdivisionLevel) refuse(path, "level out of range");
  const std::int64_t base_faces = *counts->base_faces;
  if (base_faces <= 0 || base_faces << (2 * mesh.level) != plain.face_count())
    refuse(path, "the number of faces is not base_faces times 4 to the level");
  if (mesh.base_vertices < 3 || mesh.base_vertices > plain.vertex_count()) refuse(path, "base_vertices out of range");
  for (std::int64_t f = 0; f < base_faces; ++f) mesh.base_faces.push_back(base_face(plain.faces, mesh.level, f));
  mesh.positions = plain.positions;
  SubdivisionLevel finest;
  try {
    finest = mesh.levels().back();
  } catch (const Error& error) {
    refuse(path, error.what());
  }
  for (int f = 0; f < plain.face_count(); ++f)
    if (finest.faces[f] != plain.faces[f])
      throw Error(Cause::NoSubdivisionConnectivity, path + ": a face is not the one its level has", Element::Face, f);
  if (finest.vertex_count != plain.vertex_count()) refuse(path, "the number of vertices is not the level's");
  if (!counts->control_grid && counts->creases == 0) return mesh;
  const PlyDocument document = read_ply(path);
  if (counts->creases != 0) {
    mesh.creases = read_creases(path, document, counts->creases);
    if (const PlyElement* corners = document.find("crease_corner"))
      mesh.corners = read_vertices(path, *corners, kCorner);
    base_level(mesh.base_vertices, mesh.base_faces, mesh.creases, mesh.corners);
  }
  if (counts->control_grid) {
    mesh.control = read_control(path, document, *counts->control_grid);
    displaced_form(mesh);
  }
  return mesh;
}

}  // namespace gsp
