#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <set>

#include "coder/displaced/scalar_forest.h"
#include "coder/edge_forest.h"
#include "coder/largest_descendants.h"
#include "tests/coder/crease_meshes.h"

using namespace gsp;

namespace {

/// Edges of a flat sheet as segments, by node.
struct Segments {
  std::vector<Vec3> middle, along;

  Segments(const SemiregularMesh& sheet, const std::vector<SubdivisionLevel>& levels) {
    for (const SubdivisionLevel& level : levels)
      for (const auto& [a, b] : level.edges) {
        middle.push_back((sheet.positions[a] + sheet.positions[b]) / 2);
        along.push_back(sheet.positions[b] - sheet.positions[a]);
      }
  }
  /// Whether b is parallel to a, half as long, and its middle a quarter of a's length, along its line or half the
  /// height of an equilateral triangle beside it: which children are, and nothing else.
  bool is_child(int a, int b) const {
    const Vec3 half = along[a] / 2;
    if ((along[b] - half).norm() > 1e-12 && (along[b] + half).norm() > 1e-12) return false;
    const Vec3 gap = middle[b] - middle[a];
    const double along_line = std::abs(gap.dot(half)) / half.squaredNorm(),
                 beside = gap.cross(half).norm() / half.squaredNorm();
    const bool is_half = std::abs(along_line - 0.5) < 1e-9 && beside < 1e-9;
    const bool is_inner = along_line < 1e-9 && std::abs(beside - std::sqrt(0.75)) < 1e-9;
    return is_half || is_inner;
  }
};

/// A patch of equilateral triangles with a boundary.
SemiregularMesh equilateral_sheet(int level) {
  return samples::refine(shapes::grid(3, 2), level,
                         [](const Vec3& p) { return Vec3(p.x() + p.y() / 2, p.y() * std::sqrt(0.75), 0.0); });
}

template <std::size_t N>
std::set<int> nodes_in(const std::array<int, N>& list) {
  std::set<int> nodes(list.begin(), list.end());
  nodes.erase(-1);
  return nodes;
}

/// The largest magnitude below each node, by walking up from every node.
std::vector<std::uint32_t> climbed(const EdgeForest& forest, const std::vector<std::uint32_t>& magnitude) {
  std::vector<std::uint32_t> largest(forest.nodes(), 0);
  for (int n = 0; n < forest.nodes(); ++n)
    for (int up = forest.parent[n]; up >= 0; up = forest.parent[up]) largest[up] = std::max(largest[up], magnitude[n]);
  return largest;
}

}  // namespace

TEST_CASE("children of an edge are its halves and the parallel edges inside its triangles") {
  const SemiregularMesh sheet = equilateral_sheet(3);
  std::vector<SubdivisionLevel> levels = sheet.levels();
  levels.pop_back();
  const EdgeForest forest(levels);
  const Segments segments(sheet, levels);
  REQUIRE(forest.levels() == 3);
  REQUIRE(forest.nodes() == static_cast<int>(segments.middle.size()));
  for (int l = 0; l < forest.levels(); ++l)
    for (int n = forest.level_begin[l]; n < forest.level_begin[l + 1]; ++n) {
      const bool boundary = levels[l].on_boundary(n - forest.level_begin[l]);
      std::set<int> expected;
      if (l + 1 < forest.levels())
        for (int c = forest.level_begin[l + 1]; c < forest.level_begin[l + 2]; ++c)
          if (segments.is_child(n, c)) expected.insert(c);
      CHECK(nodes_in(forest.children[n]) == expected);
      if (l + 1 < forest.levels()) CHECK(expected.size() == (boundary ? 3u : 4u));
      for (int c : expected) CHECK(forest.parent[c] == n);
      if (l == 0) CHECK(forest.parent[n] == EdgeForest::kNone);
      CHECK(nodes_in(forest.neighbours[n]).size() == (boundary ? 2u : 4u));
      for (int w : nodes_in(forest.neighbours[n])) {  // a side of the same triangle turns by 60° about a common end
        CHECK(std::abs(segments.along[w].dot(segments.along[n])) == Approx(0.5 * segments.along[n].squaredNorm()));
        CHECK((segments.middle[w] - segments.middle[n]).norm() == Approx(0.5 * segments.along[n].norm()));
      }
      CHECK(forest.on_curve(n) == boundary);
    }
}

TEST_CASE("a crease goes on in the halves of its edges alone") {
  const std::vector<SubdivisionLevel> levels = samples::pillow(2).levels();
  const EdgeForest forest(levels);
  // Four base edges of the pillow's rim, two halves each, and so on; no boundary anywhere.
  int creased[3] = {0, 0, 0};
  for (int l = 0; l < 3; ++l)
    for (int n = forest.level_begin[l]; n < forest.level_begin[l + 1]; ++n) {
      creased[l] += forest.creased[n];
      CHECK(forest.on_curve(n) == (forest.creased[n] != 0));
      if (l > 0 && forest.creased[n]) CHECK(forest.creased[forest.parent[n]]);
    }
  CHECK(creased[0] == 4);
  CHECK(creased[1] == 8);
  CHECK(creased[2] == 16);
}

TEST_CASE("the largest magnitude below a node is that of all that lead up to it") {
  const EdgeForest forest(subdivision_levels(12, shapes::icosahedron().faces, 2));
  Random random(2);
  BitplaneCoefficients coefficients;
  for (BitplaneCoefficients::Component& c : coefficients.details)
    for (int n = 0; n < forest.nodes(); ++n) c.magnitude.push_back(static_cast<std::uint32_t>(random.next() % 1000));
  const auto largest = largest_descendants(forest, coefficients);
  for (int c = 0; c < 3; ++c) {
    const std::vector<std::uint32_t> expected = climbed(forest, coefficients.details[c].magnitude);
    for (int n = 0; n < forest.nodes(); ++n) CHECK(largest[n][c] == expected[n]);
  }
}

TEST_CASE("nodes of a displaced surface are its vertices, then those of its boundary by level") {
  const std::vector<SubdivisionLevel> levels = equilateral_sheet(2).levels();
  const ScalarForest forest(levels);
  REQUIRE(forest.levels() == 3);
  REQUIRE(forest.groups.size() == 6);
  // 12 base vertices, 10 of them on the boundary; 10 edges there, 20 a level later.
  const int boundary[] = {10, 10, 20};
  int across = levels.back().vertex_count;
  for (int g = 0; g < 6; ++g) {
    const ScalarForest::Group& group = forest.groups[g];
    const int l = g / 2;
    CHECK(group.level == l);
    CHECK(group.across == (g % 2 == 1));
    if (group.across) {
      CHECK(group.begin == across);
      CHECK(group.end - group.begin == boundary[l]);
      across = group.end;
    } else {
      CHECK(group.begin == (l == 0 ? 0 : levels[l - 1].vertex_count));
      CHECK(group.end == levels[l].vertex_count);
    }
  }
  CHECK(forest.nodes() == across);
  for (int n = 0; n < levels.back().vertex_count; ++n) CHECK(forest.vertex[n] == n);
}

TEST_CASE("across a boundary each node has the two beside it along the curve, its edge's ends and its halves") {
  const SemiregularMesh sheet = equilateral_sheet(2);
  const std::vector<SubdivisionLevel> levels = sheet.levels();
  const ScalarForest forest(levels);
  for (const ScalarForest::Group& group : forest.groups) {
    if (!group.across) continue;
    const double spacing = std::ldexp(1.0, -std::max(group.level - 1, 0));  // of the edges' middles along the curve
    for (int n = group.begin; n < group.end; ++n) {
      const Vec3& at = sheet.positions[forest.vertex[n]];
      const std::set<int> beside = nodes_in(forest.neighbours[n]);
      CHECK(beside.size() == 2);
      for (int w : beside) {
        CHECK(w >= group.begin);
        CHECK(w < group.end);
        CHECK(nodes_in(forest.neighbours[w]).count(n) == 1);
        CHECK((sheet.positions[forest.vertex[w]] - at).norm() < spacing * (1.0 + 1e-9));
      }
      if (group.level == 0) {
        CHECK(nodes_in(forest.ends[n]).empty());
        continue;
      }
      const auto [a, b] = forest.ends[n];
      REQUIRE(a >= 0);
      REQUIRE(b >= 0);
      CHECK((sheet.positions[forest.vertex[a]] + sheet.positions[forest.vertex[b]] - 2 * at).norm() < 1e-12);
      CHECK(nodes_in(forest.children[n]).size() == (group.level == 1 ? 2u : 0u));
      for (int c : nodes_in(forest.children[n])) {
        CHECK(forest.parent[c] == n);
        CHECK((sheet.positions[forest.vertex[c]] - at).norm() == Approx(0.25));
      }
    }
  }
}

TEST_CASE("along the normals the scalar forest is the edges' one, behind the base's vertices") {
  const std::vector<SubdivisionLevel> levels = subdivision_levels(12, shapes::icosahedron().faces, 2);
  const ScalarForest forest(levels);
  const EdgeForest edges({levels[0], levels[1]});
  CHECK(forest.nodes() == 12 + edges.nodes());  // no boundary
  for (int v = 0; v < 12; ++v) {
    CHECK(forest.parent[v] == ScalarForest::kNone);
    CHECK(nodes_in(forest.neighbours[v]).size() == 4);  // of five, as many as fit
    for (int w : nodes_in(forest.neighbours[v])) CHECK(w < 12);
  }
  for (int n = 0; n < edges.nodes(); ++n) {
    CHECK(forest.parent[12 + n] == (edges.parent[n] < 0 ? ScalarForest::kNone : 12 + edges.parent[n]));
    for (int k = 0; k < 4; ++k) {
      CHECK(forest.children[12 + n][k] == (edges.children[n][k] < 0 ? -1 : 12 + edges.children[n][k]));
      CHECK(forest.neighbours[12 + n][k] == (edges.neighbours[n][k] < 0 ? -1 : 12 + edges.neighbours[n][k]));
    }
    const int l = n < edges.level_begin[1] ? 0 : 1;
    CHECK(forest.ends[12 + n] == levels[l].edges[n - edges.level_begin[l]]);
  }
}
