#include "mesh/topology.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "cause_of.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "mesh/weld.h"

using namespace gsp;

namespace {

std::optional<Cause> refusal(const Mesh& mesh) {
  const TopologyReport report = topology_report(mesh);
  if (report.usable()) {
    CHECK_NOTHROW(require_parameterizable(mesh));
    return std::nullopt;
  }
  try {
    require_parameterizable(mesh);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.cause() == report.refusal->cause());
    CHECK(error.index().has_value() == (error.cause() != Cause::NoFaces && error.cause() != Cause::TooSmall));
  }
  return report.refusal->cause();
}

/// A strip of n squares whose ends are joined, after a half twist or not.
Mesh strip(int n, bool twisted) {
  Mesh mesh = shapes::grid(n, 1);
  const auto joined = [&](int v) {
    const int i = v % (n + 1), j = v / (n + 1);
    return i < n ? v : (twisted ? 1 - j : j) * (n + 1);
  };
  for (Triangle& t : mesh.faces)
    for (int& v : t) v = joined(v);
  return mesh;
}

void turn(Triangle& t) { std::swap(t[1], t[2]); }

}  // namespace

TEST_CASE("known shapes have their components, loops and genus") {
  const auto check = [](const Mesh& mesh, std::size_t components, int loops, int genus) {
    const TopologyReport report = topology_report(mesh);
    CHECK(report.usable());
    CHECK(report.vertices == mesh.vertex_count());
    CHECK(report.faces == mesh.face_count());
    REQUIRE(report.components.size() == components);
    CHECK(report.boundary_loops == loops);
    int faces = 0, vertices = 0;
    for (const ComponentReport& c : report.components) {
      CHECK(c.genus == genus);
      faces += c.faces;
      vertices += c.vertices;
    }
    CHECK(faces == mesh.face_count());
    CHECK(vertices + report.isolated_vertices.size() == mesh.positions.size());
  };
  check(shapes::tetrahedron(), 1, 0, 0);
  check(shapes::sphere(2), 1, 0, 0);
  check(shapes::torus(5, 4), 1, 0, 1);
  check(shapes::lattice_torus(3, 3), 1, 0, 1);
  check(shapes::genus_slab(5, 1), 1, 0, 5);
  check(shapes::grid(1, 1), 1, 1, 0);
  check(shapes::sector_disc(7, 2), 1, 1, 0);
  check(shapes::twice(shapes::genus_slab(2, 0), {9, 0, 0}), 2, 0, 2);
  check(strip(6, false), 1, 2, 0);
  check({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 1, 1, 0);
}

TEST_CASE("holes open loops, and loops that touch in a vertex are found") {
  Mesh mesh = shapes::torus(9, 9);
  mesh.faces.erase(mesh.faces.begin() + 40);
  mesh.faces.erase(mesh.faces.begin());
  const TopologyReport report = topology_report(mesh);
  CHECK(report.usable());
  CHECK(report.boundary_loops == 2);
  CHECK(report.components[0].genus == 1);

  // Without two faces of its six that are not neighbours, the centre's faces form two fans.
  Mesh disc = shapes::sector_disc(6, 1);
  std::erase_if(disc.faces, [](const Triangle& t) { return t == Triangle{0, 1, 2} || t == Triangle{0, 4, 5}; });
  const TopologyReport touching = topology_report(disc);
  REQUIRE(touching.refusal);
  CHECK(touching.refusal->cause() == Cause::NonManifoldVertex);
  CHECK(touching.refusal->index() == 0);
  CHECK(touching.non_manifold_vertices == std::vector<int>{0});
  CHECK_FALSE(touching.components[0].manifold);
  CHECK_FALSE(touching.components[0].genus);
}

TEST_CASE("two tetrahedra that share a vertex are two spheres, and unusable") {
  Mesh mesh = shapes::twice(shapes::tetrahedron(), {0, 0, 0});
  for (Triangle& t : mesh.faces)
    for (int& v : t) v = v == 4 ? 0 : v;
  const TopologyReport report = topology_report(mesh);
  CHECK(report.refusal->cause() == Cause::NonManifoldVertex);
  REQUIRE(report.components.size() == 2);
  for (const ComponentReport& c : report.components) {
    CHECK(c.vertices == 4);
    CHECK(c.edges == 6);
    CHECK(c.genus == 0);
  }
  CHECK(report.isolated_vertices == std::vector<int>{4});
}

TEST_CASE("surfaces without faces, or with coordinates that cannot be computed with, are refused") {
  CHECK(refusal({}) == Cause::NoFaces);
  CHECK(refusal({{{0, 0, 0}}, {}}) == Cause::NoFaces);
  CHECK_THROWS_AS(require_finite_surface({}), Error);
  Mesh mesh = shapes::sphere(1, 1e30);
  CHECK(refusal(mesh) == std::nullopt);
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e100}) {
    mesh.positions[7].y() = bad;
    const TopologyReport report = topology_report(mesh);
    CHECK(report.non_finite_vertices == std::vector<int>{7});
    CHECK(report.refusal->cause() == Cause::NonFinite);
    CHECK(report.refusal->element() == Element::Vertex);
    CHECK(report.refusal->index() == 7);
    CHECK_THROWS_AS(require_finite_surface(mesh), Error);
  }
  CHECK_NOTHROW(require_finite_surface(shapes::grid(1, 1)));
}

TEST_CASE("degenerate faces: a vertex named twice is refused, a zero area is not") {
  Mesh mesh = shapes::octahedron();
  mesh.faces.push_back({2, 4, 2});
  const TopologyReport report = topology_report(mesh);
  CHECK(report.repeated_index_faces == std::vector<int>{8});
  CHECK(report.refusal->cause() == Cause::DegenerateFace);
  CHECK(report.refusal->index() == 8);
  CHECK(report.components[0].genus == 0);

  Mesh flat = shapes::octahedron();
  flat.positions[0] = flat.positions[2];
  const TopologyReport usable = topology_report(flat);
  CHECK(usable.usable());
  CHECK(usable.zero_area_faces == std::vector<int>{0, 4});
  CHECK(usable.duplicate_positions == 1);
}

TEST_CASE("duplicate faces are refused, turned or not, and the first of them is not to blame") {
  for (const Triangle copy : {Triangle{4, 0, 2}, Triangle{2, 0, 4}}) {
    Mesh mesh = shapes::octahedron();
    mesh.faces.push_back(copy);
    mesh.faces.push_back(copy);
    const TopologyReport report = topology_report(mesh);
    CHECK(report.duplicate_faces == std::vector<int>{8, 9});
    CHECK(report.refusal->cause() == Cause::DuplicateFace);
    CHECK(report.non_manifold_edges.size() == 3);
  }
  CHECK(refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}) == Cause::DuplicateFace);
}

TEST_CASE("an edge of three faces is refused with its vertices") {
  Mesh mesh = shapes::grid(1, 1);
  mesh.positions.emplace_back(0, 0, 1);
  mesh.faces.push_back({1, 2, 4});
  const TopologyReport report = topology_report(mesh);
  CHECK(report.non_manifold_edges == std::vector<std::array<int, 2>>{{1, 2}});
  CHECK(report.refusal->cause() == Cause::NonManifoldEdge);
  CHECK_FALSE(report.components[0].genus);
}

TEST_CASE("one-sided surfaces are refused") {
  for (const Mesh& mesh : {strip(5, true), strip(6, true)}) {
    const TopologyReport report = topology_report(mesh);
    CHECK(report.refusal->cause() == Cause::InconsistentOrientation);
    CHECK_FALSE(report.components[0].orientable);
    CHECK(report.components[0].manifold);
    CHECK(report.boundary_loops == 1);
    Mesh copy = mesh;
    CHECK_THROWS_AS(orient_consistently(copy), Error);
  }
}

TEST_CASE("faces that only need turning are refused, and turned on request") {
  Mesh mesh = shapes::twice(shapes::torus(8, 6), {5, 0, 0});
  const std::vector<Triangle> right = mesh.faces;
  Random random(3);
  int wrong = 0;
  for (Triangle& t : mesh.faces)
    if (random.next() % 5 == 0) {
      turn(t);
      ++wrong;
    }
  const TopologyReport report = topology_report(mesh);
  CHECK(report.refusal->cause() == Cause::InconsistentOrientation);
  CHECK(report.components[0].orientable);
  CHECK(report.components[0].genus == 1);
  CHECK_FALSE(report.misoriented_edges.empty());
  CHECK(orient_consistently(mesh) == wrong);
  CHECK(topology_report(mesh).usable());
  for (std::size_t f = 0; f < right.size(); ++f) {
    Triangle t = right[f], turned = t;
    turn(turned);
    CHECK((mesh.faces[f] == t || mesh.faces[f] == Triangle{turned[0], turned[2], turned[1]}));
  }
  CHECK(orient_consistently(mesh) == 0);
}

TEST_CASE("welding joins exact copies only, keeps the order, and takes both zeros for one") {
  const Mesh soup{{{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {1, 0, 1e-300}, {1, 0, 0}}, {{0, 1, 3}, {2, 3, 4}}};
  const Mesh mesh = weld(soup, first_at_same_position(soup.positions)).mesh;
  CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 1e-300}});
  CHECK(mesh.faces == std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}});
}

TEST_CASE("a caller's faces of vertices that do not exist are named, not followed") {
  for (const int index : {4, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, index}, {2, 2, index}, {1, 3, 2}}};
    const TopologyReport report = topology_report(mesh);
    CHECK(report.out_of_range_faces == std::vector<int>{1, 2});
    CHECK(report.repeated_index_faces.empty());
    CHECK(report.components.size() == 1);
    CHECK(refusal(mesh) == Cause::IndexOutOfRange);
    CHECK(cause_of([&] { require_finite_surface(mesh); }) == Cause::IndexOutOfRange);
    CHECK(cause_of([&] { orient_consistently(mesh); }) == Cause::IndexOutOfRange);
  }
  CHECK(refusal({{}, {{0, 0, 0}, {0, 1, 2}}}) == Cause::IndexOutOfRange);
}

TEST_CASE("more than half-edges of an int can number is refused, not wrapped around") {
  constexpr std::size_t most = std::numeric_limits<int>::max();
  CHECK_NOTHROW(require_countable(most, most / 3));
  CHECK(cause_of([] { require_countable(most + 1, 1); }) == Cause::Malformed);
  CHECK(cause_of([] { require_countable(1, most / 3 + 1); }) == Cause::Malformed);
}

TEST_CASE("a component without area is refused as such, with a face of it") {
  Mesh line{{}, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}};
  for (int i = 0; i < 6; ++i)
    line.positions.push_back(i * Vec3(1.0 / 3.0, 1.0 / 7.0, -0.1));  // collinear up to rounding
  CHECK(refusal(line) == Cause::NoArea);
  Mesh both = shapes::torus(8, 6);
  const int vertices = both.vertex_count(), faces = both.face_count();
  for (const Vec3& p : line.positions) both.positions.push_back(p + Vec3(20, 0, 0));
  for (const Triangle& t : line.faces) both.faces.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
  CHECK(refusal(both) == Cause::NoArea);
  CHECK(topology_report(both).refusal->index() == faces);
  // Within a sound component faces without area are counted, and usable.
  Mesh ridge{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
  CHECK(refusal(ridge) == std::nullopt);
  CHECK(topology_report(ridge).zero_area_faces == std::vector<int>{2});
  // A needle is thin, but has an area.
  CHECK(refusal({{{0, 0, 0}, {1e6, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}) == std::nullopt);
  // A point is a component without area, too.
  CHECK(refusal({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}) == Cause::NoArea);
}

TEST_CASE("surfaces of any size are used, or refused with the reason") {
  for (int exponent = -320; exponent <= 308; exponent += 4) {
    Mesh mesh = shapes::torus(8, 6);
    for (Vec3& p : mesh.positions) p *= std::pow(10.0, exponent);
    INFO(exponent);
    const std::optional<Cause> cause = refusal(mesh);
    if (exponent < -61)
      CHECK((cause == Cause::TooSmall || (exponent < -322 && cause == Cause::NoArea)));
    else if (exponent > 75)
      CHECK(cause == Cause::NonFinite);
    else if (exponent > -60 && exponent < 74)
      CHECK(cause == std::nullopt);
    CHECK((cause_of([&] { require_finite_surface(mesh); }) == Cause::Internal) == !cause.has_value());
  }
}
