#include "coder/base_creases.h"

#include <catch2/catch.hpp>
#include <map>

#include "tests/coder/crease_meshes.h"

using namespace gsp;

namespace {

/// A side of the stream that says what it is told and counts, by context.
struct CountingSide {
  std::map<const AdaptiveBit*, std::pair<int, int>> decisions;  ///< no, yes
  std::vector<bool> said;

  bool decide(bool actual, AdaptiveBit& context) {
    ++(actual ? decisions[&context].second : decisions[&context].first);
    said.push_back(actual);
    return actual;
  }
  int yes() const {
    int sum = 0;
    for (const auto& [context, count] : decisions) sum += count.second;
    return sum;
  }
};

/// A side that repeats what another was told.
struct RepeatingSide {
  std::vector<bool> said;
  std::size_t next = 0;

  bool decide(bool, AdaptiveBit&) { return said.at(next++); }
};

SubdivisionLevel with_creases(const Mesh& mesh, const Creases& creases) {
  return base_level(mesh.vertex_count(), mesh.faces, creases);
}

std::vector<char> told(const SubdivisionLevel& level, CountingSide& side) {
  return CreaseCoder<CountingSide>(level, side).run(level.creased);
}

/// Creases along row 0 of a lattice torus of m columns, up to a column.
Creases row(int m, int until) {
  Creases creases;
  for (int i = 0; i < until; ++i) creases.push_back({std::min(i, (i + 1) % m), std::max(i, (i + 1) % m)});
  std::sort(creases.begin(), creases.end());
  return creases;
}

}  // namespace

TEST_CASE("every edge inside is asked for once, and none on a boundary") {
  for (const Mesh& mesh : {shapes::icosahedron(), shapes::grid(4, 3)}) {
    const SubdivisionLevel level = with_creases(mesh, {});
    int inside = 0;
    for (int e = 0; e < level.edge_count(); ++e) inside += !level.on_boundary(e);
    CountingSide side;
    CHECK(told(level, side) == level.creased);
    CHECK(static_cast<int>(side.said.size()) == inside);
    CHECK(side.decisions.size() == 1);  // nothing is followed
    CHECK(side.yes() == 0);
  }
}

TEST_CASE("a straight closed curve is asked for as a curve that goes straight on") {
  const SubdivisionLevel level = with_creases(shapes::lattice_torus(6, 5), row(6, 6));
  CountingSide side;
  CHECK(told(level, side) == level.creased);
  CHECK(static_cast<int>(side.said.size()) == level.edge_count());
  // One of its six edges starts it, the first of all. The others follow, each the first of the five that are asked for
  // at its vertex.
  for (int k = 0; k <= 20; ++k) CHECK(side.said[k] == (k == 0 || k % 5 == 1));
  int curves = 0, straight = 0;
  for (const auto& [context, count] : side.decisions) {
    if (count.second == 1) ++curves;
    if (count.second == 5) {
      ++straight;
      CHECK(count.first <= 1);  // at the vertex where it closes nothing goes straight on
    }
  }
  CHECK(curves == 1);
  CHECK(straight == 1);
  CHECK(side.yes() == 6);
}

TEST_CASE("where a curve ends all its neighbours are asked for, straight on first") {
  const SubdivisionLevel level = with_creases(shapes::lattice_torus(7, 5), {{0, 1}});
  CountingSide side;
  CHECK(told(level, side) == level.creased);
  // Two ends of five other edges each: one straight on, two a step aside, two beside those.
  int ends = 0;
  for (const auto& [context, count] : side.decisions)
    if (count == std::pair<int, int>{2, 0}) ++ends;
  CHECK(ends == 5);
}

TEST_CASE("creases come back from what was said, whatever they are") {
  Random random(17);
  for (const Mesh& mesh : {samples::cube(), shapes::torus(6, 5), shapes::grid(5, 4), shapes::sector_disc(7, 1)})
    for (double share : {0.1, 0.5, 1.0}) {
      const SubdivisionLevel plain = with_creases(mesh, {});
      Creases creases;
      for (int e = 0; e < plain.edge_count(); ++e)
        if (!plain.on_boundary(e) && random.uniform() < share)
          creases.push_back(
              {std::min(plain.edges[e][0], plain.edges[e][1]), std::max(plain.edges[e][0], plain.edges[e][1])});
      std::sort(creases.begin(), creases.end());
      const SubdivisionLevel level = with_creases(mesh, creases);
      CountingSide side;
      CHECK(told(level, side) == level.creased);
      RepeatingSide repeating{side.said};
      CHECK(CreaseCoder<RepeatingSide>(plain, repeating).run({}) == level.creased);
      CHECK(repeating.next == side.said.size());
    }
}
