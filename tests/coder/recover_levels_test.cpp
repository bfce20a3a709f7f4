#include "remesh/recover_levels.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/error.h"
#include "mesh/io.h"
#include "test_meshes.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

/// The mesh with its vertices and faces in another order and its faces' corners turned.
Mesh shuffled(const Mesh& mesh) {
  Random random(3);
  std::vector<int> order(mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) order[v] = v;
  for (std::size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random.next() % (i + 1)]);
  Mesh result{std::vector<Vec3>(order.size()), mesh.faces};
  for (std::size_t v = 0; v < order.size(); ++v) result.positions[order[v]] = mesh.positions[v];
  for (Triangle& t : result.faces) {
    for (int& v : t) v = order[v];
    std::rotate(t.begin(), t.begin() + random.next() % 3, t.end());
  }
  for (std::size_t i = result.faces.size(); i-- > 1;) std::swap(result.faces[i], result.faces[random.next() % (i + 1)]);
  return result;
}

/// Faces as sets of positions, in order: equal for meshes that differ in numbering alone.
std::vector<std::array<double, 9>> surface(const Mesh& mesh) {
  std::vector<std::array<double, 9>> faces;
  for (const Triangle& t : mesh.faces) {
    std::array<std::array<double, 3>, 3> p;
    for (int k = 0; k < 3; ++k) std::copy_n(mesh.positions[t[k]].data(), 3, p[k].begin());
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    std::array<double, 9> flat;
    for (int k = 0; k < 9; ++k) flat[k] = p[k / 3][k % 3];
    faces.push_back(flat);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

TEST_CASE("levels of shuffled meshes are found again, boundaries and irregular vertices included") {
  for (const SemiregularMesh& mesh :
       {samples::bumpy_sphere(3), samples::wavy_sheet(2), samples::noise(shapes::tetrahedron(), 4),
        samples::noise(shapes::sector_disc(5, 0), 2)}) {
    const Mesh plain = shuffled(mesh.mesh());
    const SemiregularMesh found = recover_levels(plain);
    CHECK(found.level >= mesh.level);
    CHECK(surface(found.mesh()) == surface(plain));
  }
}

TEST_CASE("a mesh without subdivision connectivity is refused with the place") {
  const Mesh plain = samples::bumpy_sphere(2).mesh();
  Mesh torn = plain;
  torn.faces.pop_back();
  for (const Mesh& mesh : {torn, shapes::icosahedron()}) {
    try {
      recover_levels(mesh);
      FAIL("accepted");
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::NoSubdivisionConnectivity);
    }
  }
}

TEST_CASE("meshes of other programs are recovered") {
  struct Expected {
    const char* name;
    int level, base_faces;
  };
  const std::string shared = shared_meshes();
  if (shared.empty()) return;
  for (const Expected& expected :
       {Expected{"elephant_subd2.obj", 2, 696}, Expected{"refined_elephant_44460.ply", 2, 5558},
        Expected{"smg_random_s2.obj", 2, 500}}) {
    const Mesh plain = read_mesh(shared + "/semiregular/" + expected.name);
    const SemiregularMesh found = recover_levels(plain);
    CHECK(found.level == expected.level);
    CHECK(static_cast<int>(found.base_faces.size()) == expected.base_faces);
    CHECK(surface(found.mesh()) == surface(plain));
  }
}
