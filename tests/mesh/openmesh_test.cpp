#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "mesh/io.h"
#include "mesh/shapes.h"
#include "temporary_folder.h"

using namespace gsp;

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using OpenMeshSurface = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Starts with its smallest vertex, since a half-edge structure forgets the first corner.
Triangle rotated(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// OpenMesh passes coordinates through single precision, whatever its own are.
void check_same_in_single_precision(const Mesh& a, const Mesh& b) {
  REQUIRE(a.vertex_count() == b.vertex_count());
  REQUIRE(a.face_count() == b.face_count());
  for (int v = 0; v < a.vertex_count(); ++v)
    REQUIRE((a.positions[v] - b.positions[v]).norm() <= 1e-6 * (1.0 + a.positions[v].norm()));
  for (int f = 0; f < a.face_count(); ++f) REQUIRE(rotated(a.faces[f]) == rotated(b.faces[f]));
}

Mesh from_openmesh(const OpenMeshSurface& surface) {
  Mesh mesh;
  for (const auto vertex : surface.vertices()) {
    const auto p = surface.point(vertex);
    mesh.positions.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : surface.faces()) {
    Triangle t;
    int k = 0;
    for (const auto vertex : surface.fv_range(face)) t[k++] = vertex.idx();
    mesh.faces.push_back(t);
  }
  return mesh;
}

}  // namespace

TEST_CASE("OpenMesh reads what we write, and we read what OpenMesh writes") {
  const TemporaryFolder folder;
  omlog().disable();
  omerr().disable();
  for (const Mesh& mesh : {shapes::genus_slab(2, 1), shapes::grid(4, 3, 0.25)})
    for (const char* ending : {".ply", ".obj", ".off", ".stl"}) {
      INFO(ending);
      const std::string ours = folder.file(std::string("ours") + ending);
      const std::string theirs = folder.file(std::string("theirs") + ending);
      write_mesh(ours, mesh);
      const Mesh expected = read_mesh(ours);  // an STL numbers its vertices anew
      OpenMeshSurface surface;
      REQUIRE(OpenMesh::IO::read_mesh(surface, ours));
      check_same_in_single_precision(from_openmesh(surface), expected);
      for (const OpenMesh::IO::Options::Flag flag : {OpenMesh::IO::Options::Default, OpenMesh::IO::Options::Binary}) {
        const bool text_only = std::string(ending) == ".off" || std::string(ending) == ".obj";
        if (flag == OpenMesh::IO::Options::Binary && text_only) continue;
        REQUIRE(OpenMesh::IO::write_mesh(surface, theirs, OpenMesh::IO::Options(flag), 9));
        check_same_in_single_precision(read_mesh(theirs), expected);
      }
    }
}
