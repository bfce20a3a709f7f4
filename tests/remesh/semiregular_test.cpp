#include "remesh/semiregular.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/error.h"
#include "mesh/shapes.h"
#include "tests/cause_of.h"

using namespace gsp;

TEST_CASE("quadrisection keeps the numbering rules at every level") {
  for (const Mesh& base : {shapes::tetrahedron(), shapes::torus(4, 3), shapes::grid(2, 3)}) {
    const auto levels = subdivision_levels(base.vertex_count(), base.faces, 3);
    for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
      const SubdivisionLevel &coarse = levels[l], &fine = levels[l + 1];
      REQUIRE(fine.vertex_count == coarse.vertex_count + coarse.edge_count());
      REQUIRE(fine.face_count() == 4 * coarse.face_count());
      // The search over face sides, which is how the base level numbers its edges, must give the same numbers.
      const SubdivisionLevel searched = base_level(fine.vertex_count, fine.faces);
      CHECK(searched.edges == fine.edges);
      CHECK(searched.face_edges == fine.face_edges);
      CHECK(searched.edge_faces == fine.edge_faces);
      for (int f = 0; f < coarse.face_count(); ++f) {
        const Triangle& t = coarse.faces[f];
        for (int k = 0; k < 3; ++k) {
          CHECK(fine.faces[4 * f + k][k] == t[k]);
          CHECK(fine.faces[4 * f + 3][k] == coarse.vertex_count + coarse.face_edges[f][k]);
        }
      }
    }
  }
}

TEST_CASE("levels are counted by their faces, from below and from above") {
  // 20 base faces: 20, 80, 320, 1280, ...
  CHECK(first_level_with(20, 1.0) == 0);
  CHECK(first_level_with(20, 320.0) == 2);
  CHECK(first_level_with(20, 321.0) == 3);
  CHECK(first_level_with(20, 1e12) == kMaxSubdivisionLevel);
  CHECK(last_level_with(20, 19, 5) == 0);
  CHECK(last_level_with(20, 319, 5) == 1);
  CHECK(last_level_with(20, 320, 5) == 2);
  CHECK(last_level_with(20, 1'000'000'000, 5) == 5);
  CHECK(last_level_with(50'000'000, 50'000'000, kMaxSubdivisionLevel) == 0);
}

TEST_CASE("a base that is not an oriented manifold is refused with its face") {
  CHECK(cause_of([] { base_level(3, {{0, 1, 3}}); }) == Cause::IndexOutOfRange);
  CHECK(cause_of([] { base_level(3, {{0, 1, 1}}); }) == Cause::DegenerateFace);
  CHECK(cause_of([] { base_level(4, {{0, 1, 2}, {0, 1, 3}}); }) == Cause::InconsistentOrientation);
  CHECK(cause_of([] { base_level(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}); }) == Cause::NonManifoldEdge);
  CHECK(cause_of([] { subdivision_levels(3, {{0, 1, 2}}, 11); }) == Cause::BadOption);
}

TEST_CASE("the halves of a crease are creases, and no other edge is") {
  const Mesh base = shapes::grid(2, 2);
  Creases creases;
  for (const auto& [a, b] : base_level(base.vertex_count(), base.faces).edges)
    if (std::min(a, b) == 4) creases.push_back({std::min(a, b), std::max(a, b)});
  std::sort(creases.begin(), creases.end());
  REQUIRE(!creases.empty());
  const auto levels = subdivision_levels(base.vertex_count(), base.faces, 3, creases);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    CHECK(std::count(levels[l].creased.begin(), levels[l].creased.end(), 1) == static_cast<long>(creases.size() << l));
    if (l == 0) continue;
    for (int e = 0; e < levels[l].edge_count(); ++e) {
      if (!levels[l].creased[e]) continue;
      const int newer = std::max(levels[l].edges[e][0], levels[l].edges[e][1]) - levels[l - 1].vertex_count;
      REQUIRE(newer >= 0);
      CHECK(levels[l - 1].creased[newer]);
    }
  }
  CHECK(cause_of([&] { base_level(base.vertex_count(), base.faces, {{0, 1}}); }) == Cause::Malformed);
}
