#include "metrics/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/atomic_file.h"
#include "mesh/ply_elements.h"

namespace gsp {

namespace {

using Rgb = std::array<double, 3>;
constexpr Rgb kGray = {190, 190, 190}, kRed = {200, 16, 16};

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

void add_columns(PlyElement& element, const std::vector<PictureColumn>& columns, const ColourScale& scale) {
  for (const PictureColumn& column : columns) {
    PlyProperty& property = element.properties.emplace_back();
    property.name = column.name;
    property.type = PlyType::Float64;
    for (double value : column.values) property.values.push_back(finite(value));
  }
  PlyProperty quality = element.properties[element.properties.size() - columns.size()];
  quality.name = "quality";
  quality.type = PlyType::Float32;
  const char* names[3] = {"red", "green", "blue"};
  for (int k = 0; k < 3; ++k) {
    PlyProperty& colour = element.properties.emplace_back();
    colour.name = names[k];
    colour.type = PlyType::Uint8;
    for (double value : quality.values) colour.values.push_back(std::round(colour_of(scale, value)[k]));
  }
  element.properties.push_back(std::move(quality));
}

void write(const std::string& path, PlyElement vertices, PlyElement faces) {
  AtomicFile file(path);
  write_ply(file.stream(), {{"gsp picture"}, {std::move(vertices), std::move(faces)}});
  file.commit();
}

}  // namespace

std::array<double, 3> colour_of(const ColourScale& scale, double value) {
  const double range = scale.full - scale.neutral;
  const double share =
      range != 0.0 && std::isfinite(value) ? std::clamp((value - scale.neutral) / range, 0.0, 1.0) : 0.0;
  Rgb colour;
  for (int k = 0; k < 3; ++k) colour[k] = kGray[k] + share * (kRed[k] - kGray[k]);
  return colour;
}

void write_vertex_picture(const std::string& path, const Mesh& mesh, const std::vector<PictureColumn>& columns,
                          const ColourScale& scale) {
  PlyElement vertices = ply_vertices(mesh);
  add_columns(vertices, columns, scale);
  write(path, std::move(vertices), ply_faces(mesh));
}

void write_face_picture(const std::string& path, const Mesh& mesh, const std::vector<PictureColumn>& columns,
                        const ColourScale& scale) {
  PlyElement faces = ply_faces(mesh);
  add_columns(faces, columns, scale);
  write(path, ply_vertices(mesh), std::move(faces));
}

}  // namespace gsp
