#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <set>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/atlas/surface.h"
#include "param/removal/neighbour_lists.h"
#include "param/removal/removal_record.h"
#include "param/removal/vertex_map.h"

using namespace gsp;

namespace {

/// The triangles of a fan from one ring vertex that are upright in the plane, for any of them; none where there is no
/// such fan.
std::vector<RingTriangle> flat_fan(const Star& star, const std::vector<Vec3>& positions) {
  const int n = star.size();
  const auto area = [&](const RingTriangle& t) {
    const Vec3 a = positions[star.ring[t[0]]], b = positions[star.ring[t[1]]], c = positions[star.ring[t[2]]];
    return (b - a).cross(c - a).z();
  };
  for (int from = 0; from < n; ++from) {
    std::vector<RingTriangle> fan;
    for (int k = 1; k + 1 < n; ++k) {
      RingTriangle t{from, (from + k) % n, (from + k + 1) % n};
      std::sort(t.begin(), t.end());
      fan.push_back(t);
    }
    if (std::all_of(fan.begin(), fan.end(), [&](const RingTriangle& t) { return area(t) > 1e-6; })) return fan;
  }
  return {};
}

Vec3 place(const VertexMap& map, int v) {
  const Location& at = map.locations()[v];
  const auto& positions = map.surface().mesh.positions;
  if (at.triangle < 0) return positions[v];
  const Triangle& t = map.complex().corners(at.triangle);
  return (1.0 - at.weight1 - at.weight2) * positions[t[0]] + at.weight1 * positions[t[1]] +
         at.weight2 * positions[t[2]];
}

/// Takes vertices out in a random order wherever a flat fan fills the hole; calls visit(star, triangles) before each.
template <class Visit>
int take_out(VertexMap& map, const std::vector<char>& may, Visit visit) {
  Random random(40);
  const std::vector<Vec3>& positions = map.surface().mesh.positions;
  // A star that has a very wide wedge is not flattened as it is (flatten.h).
  const auto narrow = [&](const Star& star) {
    for (std::size_t k = 0; k < star.triangles.size(); ++k) {
      const Vec3 a = positions[star.ring[k]] - positions[star.center],
                 b = positions[star.ring[(k + 1) % star.ring.size()]] - positions[star.center];
      if (a.dot(b) < -0.9 * a.norm() * b.norm()) return false;
    }
    return true;
  };
  std::vector<int> order;
  for (int v = 0; v < static_cast<int>(positions.size()); ++v)
    if (may[v]) order.push_back(v);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.next() % i]);
  int taken = 0;
  Star star;
  for (int v : order) {
    map.complex().gather(v, star);
    const std::vector<RingTriangle> fan = flat_fan(star, positions);
    if (fan.empty() || star.size() > 10 || !narrow(star)) continue;
    visit(star, fan);
    map.remove({v, fan});
    ++taken;
  }
  return taken;
}

}  // namespace

TEST_CASE("a surface knows its edges by their first half-edge, its fans, and the area around each vertex") {
  const Mesh mesh = shapes::grid(3, 3);
  const Surface surface(mesh);
  CHECK(surface.edge_count() == 9 + 3 * 4 * 2);
  for (int e = 0; e < surface.edge_count(); ++e) {
    const int h = surface.edge_halfedge[e], twin = surface.halfedges.twin[h];
    CHECK(surface.edge_of[h] == e);
    CHECK((twin < 0 || (twin > h && surface.edge_of[twin] == e)));
  }
  // Right triangles of half a unit: at the right angle a quarter, at the others an eighth (Meyer et al. 2003).
  for (int f = 0; f < mesh.face_count(); ++f) CHECK(surface.face_area[f] == Approx(0.5));
  const auto at = [](int i, int j) { return 4 * j + i; };
  CHECK(surface.vertex_area[at(0, 0)] == Approx(0.25));
  CHECK(surface.vertex_area[at(3, 0)] == Approx(0.125 + 0.125));
  CHECK(surface.vertex_area[at(1, 1)] == Approx(1.0));
  CHECK(surface.vertex_area[at(1, 0)] == Approx(0.5));
  CHECK(surface.fan_size[at(0, 0)] == 1);
  CHECK(surface.fan_size[at(3, 0)] == 2);
  CHECK(surface.fan_size[at(2, 2)] == 6);
  // On the boundary the last neighbour has no half-edge that leaves the vertex.
  std::vector<int> neighbours;
  surface.for_each_neighbour(at(1, 0), [&](int w, int edge, bool forward) {
    neighbours.push_back(w);
    const int h = surface.edge_halfedge[edge];
    CHECK((forward ? surface.halfedges.from(h) : surface.halfedges.to(h)) == at(1, 0));
  });
  CHECK(neighbours == std::vector<int>{at(2, 0), at(1, 1), at(0, 1), at(0, 0)});
  CHECK(faces_around(surface, {at(0, 0), at(3, 0)}) == std::vector<int>{0, 4, 5});
  CHECK(vertices_of(mesh.faces, {4, 5}) == std::vector<int>{at(2, 0), at(3, 0), at(2, 1), at(3, 1)});
}

TEST_CASE("copies of a vertex on a curve are one on the whole surface") {
  // Vertices 0 and 3 are copies inside a curve, 1, 4 and 5 copies of its corner; 2 is on none.
  const Seams seams{{0, 1, -1, 0, 1, 1}, {3, -1, -1, 0, -1, -1}, 2};
  CHECK(seams.any());
  CHECK(seams.same(0, 3));
  CHECK(seams.same(1, 5));
  CHECK_FALSE(seams.same(0, 1));
  CHECK_FALSE(seams.same(2, 7));  // beyond the end: on no curve
  CHECK(seams.is_corner(4));
  CHECK_FALSE(seams.is_corner(3));
  CHECK(seams.count_whole({0, 1, 2, 3, 4, 5}) == 3);
  const Seams some = seams.of({1, 3, 0, 4, 5});
  CHECK(some.other_of(1) == 2);
  CHECK(some.other_of(2) == 1);
  CHECK(some.same(0, 4));
  CHECK(some.is_corner(3));
}

TEST_CASE("neighbours side by side are those that the faces name, each once") {
  for (const Mesh& mesh : {shapes::sphere(1), shapes::grid(3, 4), shapes::torus(4, 3)}) {
    const Surface surface(mesh);
    const NeighbourLists lists(surface);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      std::set<int> expected;
      for (const Triangle& t : mesh.faces)
        if (std::count(t.begin(), t.end(), v) > 0) expected.insert(t.begin(), t.end());
      expected.erase(v);
      CHECK(lists[v].size() == expected.size());
      CHECK(std::set<int>(lists[v].begin(), lists[v].end()) == expected);
    }
  }
}

TEST_CASE("vertices taken out of a flat sheet stay where they are in its coarser triangles") {
  // The plane of a flat star is the sheet's own, so that every vertex keeps its place, however many are taken out.
  const Mesh mesh = shapes::grid(9, 7);
  const auto surface = std::make_shared<const Surface>(mesh);
  VertexMap map(surface);
  std::vector<char> may(mesh.positions.size(), 1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {  // the sheet's four corners must stay
    const Vec3& p = mesh.positions[v];
    if ((p.x() == 0 || p.x() == 9) && (p.y() == 0 || p.y() == 7)) may[v] = 0;
  }
  const int taken = take_out(map, may, [](const Star&, const std::vector<RingTriangle>&) {});
  CHECK(taken > 40);
  int inside = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    CHECK((place(map, v) - mesh.positions[v]).norm() < 1e-9);
    inside += map.locations()[v].triangle >= 0;
  }
  CHECK(inside == taken);
  // The lists by triangle hold the same vertices, each once.
  int listed = 0;
  for (std::size_t t = 0; t < map.points().size(); ++t)
    for (int v : map.points()[t]) {
      CHECK(map.locations()[v].triangle == static_cast<int>(t));
      ++listed;
    }
  CHECK(listed == taken);
}

TEST_CASE("a record gives every removal back as it was made") {
  const Mesh mesh = shapes::grid(6, 6);
  const auto surface = std::make_shared<const Surface>(mesh);
  VertexMap map(surface);
  RemovalRecord record;
  record.surface = surface;
  struct Made {
    Star star;
    std::vector<RingTriangle> triangles;
  };
  std::vector<Made> made;
  std::vector<char> may(mesh.positions.size(), 1);
  for (int v : {0, 6, 42, 48}) may[v] = 0;
  take_out(map, may, [&](const Star& star, const std::vector<RingTriangle>& triangles) {
    made.push_back({star, triangles});
    record.add(star, triangles);
  });
  REQUIRE(record.size() == static_cast<int>(made.size()));
  bool boundary = false, inside = false;
  for (int i = record.size() - 1; i >= 0; --i) {  // in any order
    Star star;
    std::vector<RingTriangle> triangles;
    record.get(i, star, triangles);
    CHECK(star.center == made[i].star.center);
    CHECK(star.boundary == made[i].star.boundary);
    CHECK(star.ring == made[i].star.ring);
    CHECK(star.triangles == made[i].star.triangles);
    CHECK(triangles == made[i].triangles);
    (star.boundary ? boundary : inside) = true;
  }
  CHECK(boundary);
  CHECK(inside);
}

TEST_CASE("the complex as a surface has its triangles, and the whole area") {
  const Mesh mesh = shapes::grid(6, 5);
  VertexMap map(std::make_shared<const Surface>(mesh));
  std::vector<char> may(mesh.positions.size(), 1);
  for (int v : {0, 6, 35, 41}) may[v] = 0;
  const int taken = take_out(map, may, [](const Star&, const std::vector<RingTriangle>&) {});
  const CoarseSurface coarse = coarse_surface(map);
  CHECK(coarse.surface->mesh.vertex_count() == mesh.vertex_count() - taken);
  double area = 0.0;
  for (int f = 0; f < coarse.surface->mesh.face_count(); ++f) {
    CHECK(map.complex().alive(coarse.slot[f]));
    for (int k = 0; k < 3; ++k) {
      const int v = coarse.vertex[coarse.surface->mesh.faces[f][k]];
      CHECK(v == map.complex().corners(coarse.slot[f])[k]);
      CHECK(coarse.surface->mesh.positions[coarse.surface->mesh.faces[f][k]] == mesh.positions[v]);
    }
    area += coarse.surface->face_area[f];
  }
  CHECK(area == Approx(30.0));
  CHECK(surface_area(coarse.surface->mesh) == Approx(30.0));  // the outline is still the rectangle
}
