#include "coder/importance.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "coder/bitplane_coder.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

using Of = std::array<std::int8_t, 3>;

/// The urgencies of the base's edges, from positions of the base and a level above it, or more levels.
std::vector<Of> urgencies(const SemiregularMesh& mesh, int ratio, int node_levels = 1) {
  std::vector<SubdivisionLevel> levels = mesh.levels();
  std::vector<std::vector<Vec3>> positions;
  for (const SubdivisionLevel& level : levels)
    positions.emplace_back(mesh.positions.begin(), mesh.positions.begin() + level.vertex_count);
  const std::vector<SubdivisionLevel> nodes = subdivision_levels(mesh.base_vertices, mesh.base_faces, node_levels - 1);
  const EdgeForest forest(nodes);
  const SurfaceUrgency urgency(levels, forest, positions, ratio, FrameRule::ByArea);
  std::vector<Of> result;
  for (int n = 0; n < forest.nodes(); ++n) result.push_back(urgency.of(n));
  return result;
}

SemiregularMesh flat(const Mesh& base, int level = 1) {
  return samples::refine(base, level, [](const Vec3& p) { return p; });
}

}  // namespace

TEST_CASE("on a flat mesh of equal triangles normal details are not urgent, others less by their ratio") {
  for (int ratio : {1, 2, 4, 8}) {
    const auto tangential = static_cast<std::int8_t>(-kPassesPerPlane * std::log2(ratio));
    for (const Of& of : urgencies(flat(shapes::grid(4, 3)), ratio)) CHECK(of == Of{0, tangential, tangential});
  }
}

TEST_CASE("urgency goes with the root of the area around, in quarters of an octave") {
  Mesh both = shapes::grid(3, 3);
  Mesh large = both;
  for (Vec3& p : large.positions) p = 2.0 * p + Vec3(100, 0, 0);
  const int split = both.vertex_count();
  both.positions.insert(both.positions.end(), large.positions.begin(), large.positions.end());
  for (const Triangle& t : large.faces) both.faces.push_back({t[0] + split, t[1] + split, t[2] + split});
  const SemiregularMesh mesh = flat(both);
  const std::vector<Of> found = urgencies(mesh, 8);
  const SubdivisionLevel base = base_level(mesh.base_vertices, mesh.base_faces);
  // Areas 1 and 4 of a mean of 5/2: 2·log2 of 0.4 and 1.6 are -2.64 and 1.36.
  for (int e = 0; e < base.edge_count(); ++e) CHECK(found[e][0] == (base.edges[e][0] < split ? -3 : 1));
}

TEST_CASE("across a ridge of right angles tangential details count for half of what they move") {
  Mesh roof;
  roof.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  roof.faces = {{0, 1, 2}, {1, 0, 3}};  // in the planes z = 0 and y = 0, about the x axis
  const std::vector<Of> found = urgencies(flat(roof), 8);
  // Along the ridge nothing but the least share, 1/64: -4·3. Across it (n·f)² is 1/2 on both sides: 2·log2(1/2 + 1/64).
  CHECK(found[0] == Of{0, -12, -2});
}

TEST_CASE("finer nodes take what their parents have, and a base alone says nothing") {
  const SemiregularMesh sphere = samples::bumpy_sphere(1);
  const std::vector<Of> found = urgencies(sphere, 4, 3);
  const EdgeForest forest(subdivision_levels(12, shapes::icosahedron().faces, 2));
  for (int n = forest.level_begin[1]; n < forest.nodes(); ++n) CHECK(found[n] == found[forest.parent[n]]);
  for (const Of& of : urgencies(samples::bumpy_sphere(0), 4)) CHECK(of == Of{0, 0, 0});
}
