#include "param/simplify/planar_region.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>

#include "mesh/random.h"
#include "mesh/shapes.h"

using namespace gsp;

namespace {

using Hold = PlanarRegion::Hold;

/// A flat sheet, all of it a region, whose outline is held.
struct Sheet {
  RefinedSurface refined;
  PlanarRegion region;

  explicit Sheet(const Mesh& mesh) : refined(std::make_shared<const Surface>(mesh)), region(refined) {
    std::vector<int> faces(mesh.faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<int>(f);
    region.begin(faces);
    for (int v : region.vertices()) {
      const bool border = refined.original().halfedges.boundary_vertex(v);
      region.place(v, {mesh.positions[v].x(), mesh.positions[v].y()}, border ? Hold::Ring : Hold::Free);
    }
  }

  double area() const {
    double sum = 0.0;
    for (int f : region.faces())
      if (refined.alive(f)) sum += region.area(f);
    return sum;
  }
  bool upright() const {
    return std::all_of(region.faces().begin(), region.faces().end(),
                       [&](int f) { return !refined.alive(f) || region.area(f) > 0.0; });
  }
  /// The vertices on the way from a to b along edges that lie on the straight line between them; empty where none does.
  std::vector<int> straight_way(int a, int b) const {
    std::vector<int> way;
    const Complex direction = region.flat(b) - region.flat(a);
    for (int at = a; at != b;) {
      int next = -1;
      refined.for_each_outgoing(at, [&](int h) {
        for (int w : {refined.to(h), refined.from(Halfedges::prev(h))}) {
          const Complex step = region.flat(w) - region.flat(at);
          if (std::abs(cross(direction, step)) < 1e-12 && std::real(std::conj(direction) * step) > 0.0) next = w;
        }
      });
      if (next < 0) return {};
      if (next != b) way.push_back(next);
      at = next;
    }
    return way;
  }
};

int vertex_at(const Mesh& mesh, double x, double y) {
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.positions[v].x() == x && mesh.positions[v].y() == y) return v;
  return -1;
}

}  // namespace

TEST_CASE("a cut crosses each edge in its way at the line") {
  // From (0, 0) to (4, 1): the lines x = 1, 2, 3 at heights of a quarter, a half and three quarters, and the diagonals.
  const Mesh mesh = shapes::grid(4, 1);
  Sheet sheet(mesh);
  const int start = vertex_at(mesh, 0, 0), end = vertex_at(mesh, 4, 1);
  REQUIRE(sheet.region.cut(start, end));
  const std::vector<int> way = sheet.straight_way(start, end);
  // No vertex is free to move: all lie on the outline.
  std::vector<double> x;
  for (int v : way) {
    CHECK(sheet.refined.added(v));
    CHECK(sheet.region.hold(v) == Hold::Edge);
    CHECK(sheet.region.line(v) == PlanarRegion::Line(start, end));
    CHECK(sheet.region.share_on_line(v) == Approx(sheet.region.flat(v).real() / 4.0));
    x.push_back(sheet.region.flat(v).real());
  }
  CHECK(std::is_sorted(x.begin(), x.end()));
  for (double column : {1.0, 2.0, 3.0})
    CHECK(std::any_of(x.begin(), x.end(), [&](double at) { return std::abs(at - column) < 1e-12; }));
  CHECK(sheet.upright());
  CHECK(sheet.area() == Approx(4.0));
}

TEST_CASE("a free vertex beside the line goes onto it, one farther away does not") {
  // Four columns of two rows: the middle vertices lie on y = 1, the cut runs a little above it.
  for (double offset : {0.05, 0.4}) {
    const Mesh mesh = shapes::grid(4, 2);
    Sheet sheet(mesh);
    const int start = vertex_at(mesh, 0, 1), end = vertex_at(mesh, 4, 1);
    sheet.region.place(start, {0.0, 1.0 + offset}, Hold::Ring);
    sheet.region.place(end, {4.0, 1.0 + offset}, Hold::Ring);
    const double area = sheet.area();
    REQUIRE(sheet.region.cut(start, end));
    const std::vector<int> way = sheet.straight_way(start, end);
    int own = 0;
    for (double x : {1.0, 2.0, 3.0}) {
      const int v = vertex_at(mesh, x, 1);
      own += std::count(way.begin(), way.end(), v) > 0;
    }
    CHECK(own == (offset < 0.2 ? 3 : 0));
    CHECK(sheet.upright());
    CHECK(sheet.area() == Approx(area));
  }
}

TEST_CASE("a place inside gets a vertex: near a free one that one, else a new one, on a side that is near") {
  const Mesh mesh = shapes::grid(3, 3);
  Sheet near(mesh);
  const int free = vertex_at(mesh, 1, 1);
  CHECK(near.region.insert({1.05, 1.02}) == free);
  CHECK(std::abs(near.region.flat(free) - Complex(1.05, 1.02)) < 1e-15);
  CHECK(near.region.hold(free) == Hold::Ring);
  // A third of the way from all corners of a face.
  Sheet inside(mesh);
  const Complex middle(1.0 + 2.0 / 3.0, 1.0 + 1.0 / 3.0);
  const int made = inside.region.insert(middle);
  CHECK(inside.refined.added(made));
  CHECK(std::abs(inside.region.flat(made) - middle) < 1e-15);
  CHECK(inside.refined.compact().mesh.face_count() == 18 + 2);
  CHECK(inside.upright());
  CHECK(inside.area() == Approx(9.0));
  // Hardly off the middle of the side from (1, 1) to (2, 1), with which two faces are split.
  Sheet beside(mesh);
  const int on_side = beside.region.insert({1.5, 1.01});
  CHECK(beside.refined.added(on_side));
  std::vector<int> around;
  beside.refined.for_each_outgoing(on_side, [&](int h) { around.push_back(beside.refined.to(h)); });
  CHECK(around.size() == 4);
  CHECK(beside.upright());
  CHECK(beside.area() == Approx(9.0));
  // Outside there is none.
  CHECK(beside.region.insert({3.5, 1.0}) == -1);
}

TEST_CASE("pieces that are thin get thicker, and what is held stays") {
  const Mesh mesh = shapes::grid(3, 3);
  Sheet sheet(mesh);
  const int free = vertex_at(mesh, 1, 1);
  sheet.region.place(free, {1.97, 1.98}, Hold::Free);  // all but on (2, 2)
  const auto thinnest = [&] {
    double least = 1.0;
    for (int f : sheet.region.faces()) {
      const Triangle& t = sheet.refined.corners(f);
      least = std::min(least, thickness(sheet.region.flat(t[0]), sheet.region.flat(t[1]), sheet.region.flat(t[2])));
    }
    return least;
  };
  const double before = thinnest();
  REQUIRE(before < kThin);
  sheet.region.relax();
  CHECK(thinnest() > 2.0 * before);
  CHECK(sheet.area() == Approx(9.0));
  for (int v : sheet.region.vertices())
    if (sheet.region.hold(v) == Hold::Ring)
      CHECK(sheet.region.flat(v) == Complex(mesh.positions[v].x(), mesh.positions[v].y()));
}

TEST_CASE("a vertex held on a line is moved along it only") {
  const Mesh mesh = shapes::grid(4, 2);
  Sheet sheet(mesh);
  const int start = vertex_at(mesh, 0, 1), end = vertex_at(mesh, 4, 1), first = vertex_at(mesh, 1, 1);
  REQUIRE(sheet.region.cut(start, end));  // along the edges there: nothing is made
  for (double x : {1.0, 2.0, 3.0}) {
    CHECK(sheet.region.hold(vertex_at(mesh, x, 1)) == Hold::Edge);
    CHECK(sheet.region.share_on_line(vertex_at(mesh, x, 1)) == x / 4.0);
  }
  sheet.region.place(first, {0.01, 1.0}, Hold::Edge);
  sheet.region.relax();
  CHECK(sheet.region.flat(first).imag() == 1.0);
  CHECK(sheet.region.flat(first).real() > 0.1);
}

TEST_CASE("added vertices on no cut go out again, those on one stay") {
  const Mesh mesh = shapes::grid(4, 4);
  Sheet sheet(mesh);
  const int start = vertex_at(mesh, 0, 0), end = vertex_at(mesh, 4, 3);
  REQUIRE(sheet.region.cut(start, end));
  const std::vector<int> way = sheet.straight_way(start, end);
  REQUIRE(!way.empty());
  Random random(5);
  for (int k = 0; k < 12; ++k) {
    const int v = sheet.region.insert({0.1 + 3.8 * random.uniform(), 0.1 + 3.8 * random.uniform()});
    REQUIRE(v >= 0);
    if (sheet.refined.added(v) && std::count(way.begin(), way.end(), v) == 0)
      sheet.region.place(v, sheet.region.flat(v), Hold::Free);
  }
  const int before = sheet.refined.compact().mesh.vertex_count();
  sheet.region.take_out();
  CHECK(sheet.refined.compact().mesh.vertex_count() < before);
  CHECK(sheet.upright());
  CHECK(sheet.area() == Approx(16.0));
  CHECK(!sheet.straight_way(start, end).empty());
}
