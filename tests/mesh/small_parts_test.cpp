#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "cause_of.h"
#include "mesh/bounding_box.h"
#include "mesh/disjoint_sets.h"
#include "mesh/edge.h"
#include "mesh/edge_groups.h"
#include "mesh/files/orientation.h"
#include "mesh/files/polygon_builder.h"
#include "mesh/files/text_scanner.h"
#include "mesh/fixed_order.h"
#include "mesh/ply.h"
#include "mesh/ply_elements.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "mesh/surface_file.h"
#include "mesh/words.h"

using namespace gsp;

namespace {

enum class Colour { Red, DarkGreen };
constexpr Colour kColours[] = {Colour::Red, Colour::DarkGreen};
const char* colour_name(Colour colour) { return colour == Colour::Red ? "red" : "dark-green"; }

/// Members of each set with their colours, by following every relation until nothing changes.
struct Flood {
  std::vector<int> set, colour;

  explicit Flood(int count) : set(count), colour(count, 0) {
    for (int i = 0; i < count; ++i) set[i] = i;
  }
  bool unite(int x, int y, bool differ) {
    if (set[x] == set[y]) return (colour[x] != colour[y]) == differ;
    const bool turn = (colour[x] != colour[y]) != differ;
    const int from = set[y], to = set[x];
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set[i] == from) {
        set[i] = to;
        colour[i] ^= turn;
      }
    return true;
  }
};

}  // namespace

TEST_CASE("sets that are joined have their smallest member as root, and signs that agree with every relation") {
  constexpr int kCount = 60;
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    DisjointSets sets(kCount);
    Flood flood(kCount);
    for (int step = 0; step < 70; ++step) {
      const int x = static_cast<int>(random.next() % kCount), y = static_cast<int>(random.next() % kCount);
      const bool differ = random.next() % 2 == 1;
      CHECK(sets.unite(x, y, differ) == flood.unite(x, y, differ));
    }
    for (int x = 0; x < kCount; ++x) {
      int least = x;
      for (int y = 0; y < kCount; ++y)
        if (flood.set[y] == flood.set[x]) least = std::min(least, y);
      CHECK(sets.root(x) == least);
      CHECK(sets.odd(x) == (flood.colour[x] != flood.colour[least]));
    }
  }
  DisjointSets triangle(3);
  CHECK(triangle.unite(0, 1, true));
  CHECK(triangle.unite(1, 2, true));
  CHECK_FALSE(triangle.unite(2, 0, true));  // three cannot all differ
  CHECK(triangle.unite(2, 0, false));
}

TEST_CASE("half-edges are grouped by their edge, in order, without faces that name a vertex twice") {
  Mesh mesh = shapes::tetrahedron();
  mesh.faces.push_back({0, 0, 1});
  mesh.positions.push_back({9, 9, 9});
  mesh.faces.push_back({1, 0, 4});  // a third face at an edge
  const EdgeGroups groups(mesh);
  CHECK(groups.size() == 6 + 2);
  std::vector<std::array<int, 2>> edges;
  int halfedges = 0;
  for (int e = 0; e < groups.size(); ++e) {
    for (int h : groups[e]) {
      const Triangle& t = mesh.faces[h / 3];
      CHECK_FALSE(names_vertex_twice(t));
      const auto edge = ascending(t[h % 3], t[(h + 1) % 3]);
      if (h == groups[e].front()) edges.push_back(edge);
      CHECK(edge == edges.back());
      ++halfedges;
    }
    CHECK(std::is_sorted(groups[e].begin(), groups[e].end()));
  }
  CHECK(halfedges == 15);
  CHECK(std::is_sorted(edges.begin(), edges.end()));
  CHECK(groups[0].size() == 3);  // (0, 1)
  CHECK(ascending(5, 2) == std::array<int, 2>{2, 5});
}

TEST_CASE("the turn of three points is exact where doubles would round it") {
  Random random(8);
  int straight = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    // Points near a line through large integers; exact products have 108 bits.
    const auto number = [&] { return static_cast<long long>(random.next() % (1LL << 50)); };
    const long long ax = number(), ay = number(), dx = number() / 1024, dy = number() / 1024;
    const long long s = 1 + static_cast<long long>(random.next() % 500),
                    t = 1 + static_cast<long long>(random.next() % 500);
    const long long off = static_cast<long long>(random.next() % 3) - 1;
    const long long bx = ax + s * dx, by = ay + s * dy, cx = ax - t * dx, cy = ay - t * dy + off;
    const __int128 exact = static_cast<__int128>(bx - ax) * (cy - ay) - static_cast<__int128>(by - ay) * (cx - ax);
    const auto point = [](long long x, long long y) { return Eigen::Vector2d(double(x), double(y)); };
    const int expected = exact > 0 ? 1 : exact < 0 ? -1 : 0;
    CHECK(orientation(point(ax, ay), point(bx, by), point(cx, cy)) == expected);
    straight += expected == 0;
  }
  CHECK(straight > 500);
  CHECK(orientation({0, 0}, {1, 0}, {0, 1}) == 1);
}

TEST_CASE("polygons of a file are cut to triangles that know which polygon they are of") {
  SurfaceFile file;
  file.numbering.first = 1;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) file.mesh.positions.emplace_back(i, j, 0);
  PolygonBuilder builder(file);
  const auto add = [&](std::vector<long long> corners) { builder.add(corners); };
  add({0, 1, 4});
  CHECK(file.numbering.polygons.empty());  // faces are polygons so far
  add({1, 2, 6, 5});
  add({3, 7});
  add({2, 3, 7});
  builder.finish();
  CHECK(file.mesh.faces.size() == 4);
  CHECK(file.numbering.polygons == std::vector<int>{0, 1, 1, 3});
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].substr(0, 2) == "1 ");
  double area = 0.0;
  for (int f = 0; f < 4; ++f) area += face_area(file.mesh, f);
  CHECK(area == Approx(0.5 + 1.0 + 0.5));
  try {
    add({0, 1, 8});
    FAIL("it was taken");
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::IndexOutOfRange);
    CHECK(error.place()->index == 5);  // the fifth polygon, counted from 1
  }
  CHECK(cause_of([&] { add({0, 1, -1}); }) == Cause::IndexOutOfRange);
  CHECK(cause_of([&] { add({0, 5, 1, 4}); }) == Cause::PolygonNotSimple);
}

TEST_CASE("errors are told as the file counts") {
  const Numbering numbering{1, {4, 2, 0}, {7}};
  CHECK(in_file(Error(Cause::Malformed, "x", Element::Vertex, 1), numbering).place()->index == 3);
  CHECK(in_file(Error(Cause::Malformed, "x", Element::Face, 0), numbering).place()->index == 8);
  // What was added later has no number in the file.
  CHECK(in_file(Error(Cause::Malformed, "x", Element::Vertex, 5), numbering).place()->index == 5);
  CHECK(in_file(Error(Cause::Malformed, "x", Element::Vertex, 5), {}).place()->index == 5);
  SurfaceFile file;
  file.mesh = shapes::grid(1, 1);
  file.mesh.positions.push_back(file.mesh.positions[0]);
  file.mesh.faces.push_back({0, 4, 1});
  weld(file, 1e-9);
  CHECK(file.mesh.vertex_count() == 4);
  CHECK(file.mesh.face_count() == 2);
  CHECK(file.numbering.polygons == std::vector<int>{0, 1});
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].find("1 vertices were joined") == 0);
}

TEST_CASE("text is taken apart by white space of all kinds, comments apart") {
  TextScanner text("v 1.5\t-2e3 # hidden 7\r\n\r\nf 1/2 x\rlast", '#');
  CHECK(text.next() == "v");
  CHECK(text.number() == 1.5);
  CHECK(text.numbers_to_line_end() == 1);
  CHECK(text.next_in_line().empty());
  CHECK(text.next() == "f");
  CHECK(text.next_in_line() == "1/2");
  text.put_back(2);
  CHECK(text.next_in_line() == "/2");
  CHECK(cause_of([&] { text.number(); }) == Cause::Malformed);
  CHECK(text.next() == "last");
  CHECK(text.at_end());
  CHECK(text.left() == 0);
  CHECK(cause_of([&] { text.integer(); }) == Cause::Truncated);
  TextScanner lines("a\nb\n\nc d");
  for (int k = 0; k < 3; ++k) lines.next();
  CHECK(lines.line() == 4);
  CHECK(cause_of([&] { lines.require_end("nothing more"); }) == Cause::Malformed);
  lines.skip_line();
  CHECK(lines.next().empty());
}

TEST_CASE("numbers are whole tokens, whatever the locale") {
  double value = 0.0;
  CHECK(parse_number("-1.25e2", value));
  CHECK(value == -125.0);
  CHECK(parse_number("+.5", value));
  CHECK(value == 0.5);
  CHECK(parse_number("1e999", value));
  CHECK(value == std::numeric_limits<double>::infinity());
  CHECK(parse_number("1e-999", value));
  CHECK(value == 0.0);
  CHECK(parse_number("nan", value));
  CHECK(std::isnan(value));
  for (const char* wrong : {"", "1,5", "1.5x", "0x10", "--1", "1e", "+-1"}) {
    INFO(wrong);
    CHECK_FALSE(parse_number(wrong, value));
  }
  long long whole = 0;
  CHECK(parse_integer("-42", whole));
  CHECK(whole == -42);
  for (const char* wrong : {"", "1.0", "99999999999999999999", "7f"}) CHECK_FALSE(parse_integer(wrong, whole));
  const std::string shown = gsp::quoted(std::string(500, 'a') + "\x01");
  CHECK(shown.size() < 200);
  CHECK(gsp::quoted("a\nb").find('\n') == std::string::npos);
}

TEST_CASE("products in a fixed order are the products") {
  const Vec3 a(1, 2, 3), b(-4, 5, 0.5);
  CHECK(dot(a, b) == -4 + 10 + 1.5);
  CHECK(cross(a, b) == Vec3(1 - 15, -12 - 0.5, 5 + 8));
  Eigen::Matrix3d m;
  m << 1, 0, 2, 0, 3, 0, -1, 0, 1;
  CHECK(times(m, a) == Vec3(7, 6, 2));
  CHECK(*unit(Vec3(0, 3, 4)) == Vec3(0, 0.6, 0.8));
  for (const Vec3& none :
       {Vec3(0, 0, 0), Vec3(1e-160, 0, 0), Vec3(0, 1e160, 0), Vec3(0, 0, std::numeric_limits<double>::quiet_NaN())})
    CHECK_FALSE(unit(none));
}

TEST_CASE("the bounding box is that of vertices with a face") {
  Mesh mesh = shapes::octahedron();
  mesh.positions.push_back({50, 0, 0});
  CHECK(bounding_box(mesh).min() == Vec3(-1, -1, -1));
  CHECK(bounding_box(mesh).max() == Vec3(1, 1, 1));
  mesh.faces.clear();
  CHECK(bounding_box(mesh).isEmpty());
}

TEST_CASE("a surface's elements hold its coordinates and its faces' corners") {
  const Mesh mesh = shapes::grid(2, 1);
  const PlyElement vertices = ply_vertices(mesh), faces = ply_faces(mesh);
  CHECK(vertices.count == 6);
  REQUIRE(vertices.scalar("y") != nullptr);
  for (int v = 0; v < 6; ++v) CHECK(vertices.scalar("y")->values[v] == mesh.positions[v].y());
  const PlyProperty* corners = faces.list("vertex_indices");
  REQUIRE(corners != nullptr);
  CHECK(corners->starts == std::vector<std::size_t>{0, 3, 6, 9, 12});
  for (int f = 0; f < 4; ++f)
    for (int k = 0; k < 3; ++k) CHECK(corners->values[3 * f + k] == mesh.faces[f][k]);
}

TEST_CASE("words name the values of an enumeration and are read back") {
  CHECK(words_of(kColours, colour_name) == std::vector<std::string>{"red", "dark-green"});
  CHECK(value_of(kColours, colour_name, "dark-green", "colour") == Colour::DarkGreen);
  try {
    value_of(kColours, colour_name, "green", "colour");
    FAIL("it was taken");
  } catch (const Error& error) {
    CHECK(error.cause() == Cause::BadOption);
    CHECK(std::string(error.what()) == "unknown colour green");
  }
}
