// yardstick MESH FACES OUT.ply: what merely decimating costs. Decimates a surface to so many faces with OpenMesh's
// quadric error decimater as it stands, and writes the result.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <cstdlib>
#include <iostream>

#include "mesh/error.h"
#include "mesh/io.h"

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Decimated = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

void load(const gsp::Mesh& mesh, Decimated& surface) {
  surface.reserve(mesh.positions.size(), 3 * mesh.faces.size() / 2, mesh.faces.size());
  for (const gsp::Vec3& p : mesh.positions) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const gsp::Triangle& t : mesh.faces)
    surface.add_face(OpenMesh::VertexHandle(t[0]), OpenMesh::VertexHandle(t[1]), OpenMesh::VertexHandle(t[2]));
}

gsp::Mesh taken_from(Decimated& surface) {
  surface.garbage_collection();
  gsp::Mesh mesh;
  for (const auto vertex : surface.vertices()) {
    const auto p = surface.point(vertex);
    mesh.positions.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : surface.faces()) {
    gsp::Triangle& t = mesh.faces.emplace_back();
    int corner = 0;
    for (const auto vertex : face.vertices()) t[corner++] = vertex.idx();
  }
  return mesh;
}

}  // namespace

int main(int count, char** arguments) {
  const long faces = count == 4 ? std::strtol(arguments[2], nullptr, 10) : 0;
  if (faces <= 0) {
    std::cerr << "usage: yardstick MESH FACES OUT.ply\n";
    return 2;
  }
  try {
    Decimated surface;
    load(gsp::read_mesh(arguments[1]), surface);
    OpenMesh::Decimater::DecimaterT<Decimated> decimater(surface);
    OpenMesh::Decimater::ModQuadricT<Decimated>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, static_cast<std::size_t>(faces));
    const gsp::Mesh mesh = taken_from(surface);
    gsp::write_mesh(arguments[3], mesh);
    std::cout << mesh.face_count() << " faces\n";
  } catch (const gsp::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
