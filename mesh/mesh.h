#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

using Vec3 = Eigen::Vector3d;

/// Three vertex indices in counter-clockwise order seen from outside.
using Triangle = std::array<int, 3>;

/// A triangle surface as the files hold it: #V positions and #F triangles of indices into them.
/// Flat arrays and no adjacency, because the coder, the metrics and the remesher need none; those that do build
/// `Halfedges` from it. Isolated vertices are allowed everywhere and carry no surface.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> faces;

  int vertex_count() const { return static_cast<int>(positions.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }
};

/// Length of the diagonal of the axis-aligned box of all vertices that a face uses; 0 for a mesh without faces.
/// It is the peak that PSNR is taken against. Throws Error(IndexOutOfRange). O(V + F).
double bounding_box_diagonal(const Mesh& mesh);

/// Area of one face, 0 for a degenerate one. The face and its vertices exist.
double face_area(const Mesh& mesh, int face);

/// Sum of all face areas, in face order. Throws Error(IndexOutOfRange).
double surface_area(const Mesh& mesh);

/// #V, the sum over the faces of each vertex of their area vectors, twice as long: normals by area, of any length, 0
/// where no face is. The faces' vertices exist. O(V + F).
std::vector<Vec3> vertex_normals(const Mesh& mesh);

}  // namespace gsp
