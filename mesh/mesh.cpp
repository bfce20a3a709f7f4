#include "mesh/mesh.h"

#include <Eigen/Geometry>

#include "mesh/bounding_box.h"
#include "mesh/topology.h"

namespace gsp {

Eigen::AlignedBox3d bounding_box(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Triangle& face : mesh.faces)
    for (int vertex : face) box.extend(mesh.positions[vertex]);
  return box;
}

double bounding_box_diagonal(const Mesh& mesh) {
  require_indices(mesh);
  return mesh.faces.empty() ? 0.0 : bounding_box(mesh).diagonal().norm();
}

double face_area(const Mesh& mesh, int face) {
  const Triangle& t = mesh.faces[face];
  const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]];
  const Vec3 b = mesh.positions[t[2]] - mesh.positions[t[0]];
  return 0.5 * a.cross(b).norm();
}

double surface_area(const Mesh& mesh) {
  require_indices(mesh);
  double sum = 0.0;
  for (int f = 0; f < mesh.face_count(); ++f) sum += face_area(mesh, f);
  return sum;
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const Triangle& t : mesh.faces) {
    const Vec3 normal =
        (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (int v : t) normals[v] += normal;
  }
  return normals;
}

}  // namespace gsp
