#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <functional>
#include <string>

#include "coder/anchors.h"
#include "mesh/error.h"

namespace gsp {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

HalfedgeMesh to_openmesh(const Mesh& mesh) {
  HalfedgeMesh result;
  result.request_vertex_status();
  result.request_edge_status();
  result.request_face_status();
  result.reserve(mesh.positions.size(), 3 * mesh.faces.size() / 2, mesh.faces.size());
  std::vector<HalfedgeMesh::VertexHandle> vertices;
  vertices.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) vertices.push_back(result.add_vertex({p.x(), p.y(), p.z()}));
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.faces[f];
    if (!result.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid())
      throw Error(Cause::NonManifoldEdge, "decimation needs a manifold surface", Element::Face, f);
  }
  return result;
}

Mesh from_openmesh(const HalfedgeMesh& mesh) {
  Mesh result;
  std::vector<int> index(mesh.n_vertices(), -1);
  for (const auto face : mesh.faces()) {
    Triangle t;
    int k = 0;
    for (const auto vertex : face.vertices()) {
      int& i = index[vertex.idx()];
      if (i < 0) {
        i = result.vertex_count();
        const auto& p = mesh.point(vertex);
        result.positions.emplace_back(p[0], p[1], p[2]);
      }
      t[k++] = i;
    }
    result.faces.push_back(t);
  }
  return result;
}

}  // namespace

std::vector<Mesh> decimate(const Mesh& mesh, const std::vector<int>& face_counts, Progress& progress) {
  if (!std::is_sorted(face_counts.begin(), face_counts.end(), std::greater<>()) ||
      (!face_counts.empty() && face_counts.back() < 1))
    throw Error(Cause::BadOption, "face counts of a decimation must be positive and fall");
  HalfedgeMesh work = to_openmesh(mesh);
  OpenMesh::Decimater::DecimaterT<HalfedgeMesh> decimater(work);
  OpenMesh::Decimater::ModQuadricT<HalfedgeMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  if (!decimater.initialize()) throw Error(Cause::Internal, "the decimater does not accept its module");
  std::vector<Mesh> results;
  for (std::size_t i = 0; i < face_counts.size(); ++i) {
    progress.report("decimate", static_cast<double>(i) / face_counts.size());
    decimater.decimate_to_faces(0, face_counts[i]);
    // The decimater counts deleted faces as present; the quadrics are vertex properties and move along.
    work.garbage_collection();
    results.push_back(from_openmesh(work));
  }
  return results;
}

}  // namespace gsp
