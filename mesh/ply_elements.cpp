#include "mesh/ply_elements.h"

namespace gsp {

PlyElement ply_vertices(const Mesh& mesh) {
  PlyElement element{"vertex", mesh.positions.size(), {}};
  for (int k = 0; k < 3; ++k) {
    PlyProperty& property = element.properties.emplace_back();
    property.name = std::string(1, static_cast<char>('x' + k));
    property.values.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions) property.values.push_back(p[k]);
  }
  return element;
}

PlyElement ply_faces(const Mesh& mesh) {
  PlyElement element{"face", mesh.faces.size(), {}};
  PlyProperty& corners = element.properties.emplace_back();
  corners.name = "vertex_indices";
  corners.type = PlyType::Int32;
  corners.count_type = PlyType::Uint8;
  corners.values.reserve(3 * mesh.faces.size());
  corners.starts.push_back(0);
  for (const Triangle& t : mesh.faces) {
    corners.values.insert(corners.values.end(), t.begin(), t.end());
    corners.starts.push_back(corners.values.size());
  }
  return element;
}

}  // namespace gsp
