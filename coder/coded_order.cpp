#include "coder/coded_order.h"

namespace gsp {

namespace {

/// Faces of one level in the coded numbering, and in the source's which face each is and which of its corners is corner
/// 0.
struct FaceMap {
  std::vector<int> source, corner;
};

/// Child k keeps corner k, so children turn with their parent; the middle child is the mean of all corners and turns
/// too.
FaceMap children(const FaceMap& parents) {
  FaceMap map;
  map.source.reserve(4 * parents.source.size());
  map.corner.reserve(4 * parents.source.size());
  for (std::size_t f = 0; f < parents.source.size(); ++f)
    for (int child = 0; child < 4; ++child) {
      map.source.push_back(4 * parents.source[f] + (child < 3 ? (child + parents.corner[f]) % 3 : 3));
      map.corner.push_back(parents.corner[f]);
    }
  return map;
}

}  // namespace

std::vector<int> coded_vertex_order(const SemiregularMesh& mesh, const CodedBase& base) {
  SubdivisionLevel source = base_level(mesh.base_vertices, mesh.base_faces);
  SubdivisionLevel coded = base_level(base.vertices, base.faces);
  FaceMap map{base.source_face, base.source_corner};
  std::vector<int> order = base.source_vertex;
  for (int l = 0; l < mesh.level; ++l) {
    order.resize(coded.vertex_count + coded.edge_count());
    for (int f = 0; f < coded.face_count(); ++f)
      for (int k = 0; k < 3; ++k)
        order[coded.vertex_count + coded.face_edges[f][k]] =
            source.vertex_count + source.face_edges[map.source[f]][(k + map.corner[f]) % 3];
    map = children(map);
    source = subdivide(source);
    coded = subdivide(coded);
  }
  return order;
}

SemiregularMesh in_coded_order(const SemiregularMesh& mesh, const CodedBase& base) {
  SemiregularMesh coded;
  coded.level = mesh.level;
  coded.base_vertices = base.vertices;
  coded.base_faces = base.faces;
  coded.creases = base.creases;
  coded.corners = base.corners;
  for (int v : coded_vertex_order(mesh, base)) coded.positions.push_back(mesh.positions[v]);
  if (!mesh.control) return coded;
  coded.control = ControlMesh{{}, mesh.control->grid};
  for (int b : base.source_vertex) coded.control->points.push_back(mesh.control->points[b]);
  return coded;
}

}  // namespace gsp
