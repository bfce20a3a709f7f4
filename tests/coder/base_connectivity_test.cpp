#include "coder/base_connectivity.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "coder/coded_order.h"
#include "mesh/error.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

CodedBase decoded(const Bytes& bytes, std::size_t faces) {
  return decode_connectivity(static_cast<int>(faces), false, bytes.data(), bytes.data() + bytes.size());
}

}  // namespace

TEST_CASE("connectivity comes back as the renumbering that the encoder names") {
  for (const Mesh& mesh :
       {shapes::tetrahedron(), shapes::sphere(2), shapes::torus(7, 5), shapes::grid(4, 3), shapes::genus_slab(3, 1),
        shapes::sector_disc(3, 0), shapes::twice(shapes::grid(2, 2), Vec3(9, 0, 0))}) {
    Bytes bytes;
    const CodedBase sent = encode_connectivity(mesh.faces, bytes);
    const CodedBase received = decoded(bytes, mesh.faces.size());
    CHECK(received.vertices == mesh.vertex_count());
    CHECK(received.faces == sent.faces);
    std::vector<int> seen(mesh.faces.size(), 0);
    for (std::size_t f = 0; f < sent.faces.size(); ++f) {
      ++seen[sent.source_face[f]];
      for (int k = 0; k < 3; ++k)
        CHECK(sent.source_vertex[sent.faces[f][k]] == mesh.faces[sent.source_face[f]][(sent.source_corner[f] + k) % 3]);
    }
    CHECK(seen == std::vector<int>(mesh.faces.size(), 1));
  }
}

TEST_CASE("a regular mesh costs next to nothing") {
  const Mesh mesh = shapes::lattice_torus(20, 15);
  Bytes bytes;
  encode_connectivity(mesh.faces, bytes);
  CHECK(8.0 * bytes.size() / mesh.vertex_count() < 1.0);
}

TEST_CASE("the coded order carries every finer vertex to its place") {
  const SemiregularMesh mesh = samples::bumpy_sphere(3);
  Bytes bytes;
  const CodedBase base = encode_connectivity(mesh.base_faces, bytes);
  const Mesh before = mesh.mesh(), after = in_coded_order(mesh, base).mesh();
  const std::vector<int> order = coded_vertex_order(mesh, base);
  CHECK(std::set<int>(order.begin(), order.end()).size() == mesh.positions.size());
  // The same set of oriented faces, each turned so that its smallest vertex comes first.
  const auto canonical = [](Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::set<Triangle> expected, found;
  for (const Triangle& t : before.faces) expected.insert(canonical(t));
  for (const Triangle& t : after.faces) found.insert(canonical({order[t[0]], order[t[1]], order[t[2]]}));
  CHECK(found == expected);
}

TEST_CASE("damaged connectivity is refused or some valid surface, never a crash") {
  const Mesh mesh = shapes::genus_slab(2, 1);
  Bytes bytes;
  encode_connectivity(mesh.faces, bytes);
  Random random(3);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Bytes damaged = bytes;
    damaged[random.next() % damaged.size()] ^= 1 << random.next() % 8;
    damaged.resize(1 + random.next() % damaged.size());
    try {
      const CodedBase base = decoded(damaged, mesh.faces.size());
      CHECK_NOTHROW(base_level(base.vertices, base.faces));
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::BadStream);
      ++refused;
    }
  }
  CHECK(refused > 200);
}
