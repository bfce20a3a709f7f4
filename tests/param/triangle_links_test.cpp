#include "param/atlas/triangle_links.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesh/shapes.h"

using namespace gsp;

namespace {

TriangleLinks links_of(const Mesh& mesh) {
  const Halfedges halfedges(mesh);
  return {mesh.faces, halfedges.twin, halfedges.outgoing};
}

/// Twins and outgoing half-edges are what the faces alone say.
void check_links(const TriangleLinks& links) {
  std::map<std::pair<int, int>, int> halfedge;
  std::set<int> used;
  for (int h = 0; h < static_cast<int>(links.twin.size()); ++h) {
    if (!links.alive(h / 3)) continue;
    CHECK(halfedge.emplace(std::pair(links.from(h), links.to(h)), h).second);
    used.insert(links.from(h));
  }
  for (const auto& [ends, h] : halfedge) {
    const auto back = halfedge.find({ends.second, ends.first});
    CHECK(links.twin[h] == (back == halfedge.end() ? -1 : back->second));
  }
  for (int v = 0; v < static_cast<int>(links.outgoing.size()); ++v) {
    CHECK((links.outgoing[v] >= 0) == (used.count(v) == 1));
    if (links.outgoing[v] < 0) continue;
    CHECK(links.alive(links.outgoing[v] / 3));
    CHECK(links.from(links.outgoing[v]) == v);
  }
}

int alive_faces(const TriangleLinks& links) {
  int count = 0;
  for (int f = 0; f < static_cast<int>(links.faces.size()); ++f) count += links.alive(f);
  return count;
}

int find(const TriangleLinks& links, int from, int to) {
  for (int h = 0; h < static_cast<int>(links.twin.size()); ++h)
    if (links.alive(h / 3) && links.from(h) == from && links.to(h) == to) return h;
  return -1;
}

int middle_of(TriangleLinks& links) {
  links.outgoing.push_back(-1);
  return static_cast<int>(links.outgoing.size()) - 1;
}

/// A hexagon of six faces around vertex 0.
Mesh hexagon() { return shapes::sector_disc(6, 0); }

/// Where the corners of the hexagon's faces lie, for `collapsible`.
auto in_plane(const TriangleLinks& links, const std::vector<Complex>& at) {
  return [&links, &at](int h) { return std::pair(at[links.to(h)], at[links.from(Halfedges::prev(h))]); };
}

std::vector<Complex> flat(const Mesh& mesh) {
  std::vector<Complex> at;
  for (const Vec3& p : mesh.positions) at.push_back({p.x(), p.y()});
  return at;
}

}  // namespace

TEST_CASE("thickness is the height over the longest side, with the sign of the area") {
  CHECK(thickness({0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}) == Approx(std::sqrt(0.75)));
  CHECK(thickness({0, 0}, {2, 0}, {0, 2}) == Approx(0.5));
  CHECK(thickness({0, 0}, {0, 2}, {2, 0}) == Approx(-0.5));
  CHECK(thickness({0, 0}, {10, 0}, {5, 0.1}) == Approx(0.01));
  CHECK(thickness({1, 1}, {1, 1}, {1, 1}) == 0.0);
}

TEST_CASE("an edge inside is halved on both sides, one on the boundary on its own") {
  TriangleLinks links = links_of(hexagon());
  const int inside = find(links, 0, 1), back = links.twin[inside], apex = links.from(Halfedges::prev(inside));
  const int m = middle_of(links);
  links.split(inside, m);
  check_links(links);
  CHECK(alive_faces(links) == 8);
  CHECK(links.from(inside) == 0);
  CHECK(links.to(inside) == m);
  CHECK(links.from(back) == 1);
  CHECK(links.to(back) == m);
  CHECK(links.faces[6] == Triangle{m, 1, apex});  // that of the half-edge first
  const int border = find(links, 1, 2);
  REQUIRE(links.twin[border] < 0);
  links.split(border, middle_of(links));
  check_links(links);
  CHECK(alive_faces(links) == 9);
  CHECK(find(links, 1, 2) < 0);
}

TEST_CASE("a vertex put into a face leaves it its first side") {
  TriangleLinks links = links_of(shapes::tetrahedron());
  const Triangle before = links.faces[2];
  const int m = middle_of(links);
  links.insert(2, m);
  check_links(links);
  CHECK(links.faces[2] == Triangle{before[0], before[1], m});
  CHECK(links.faces[4] == Triangle{before[1], before[2], m});
  CHECK(links.faces[5] == Triangle{before[2], before[0], m});
  int around = 0;
  links.for_each_outgoing(m, false, [&](int h) {
    CHECK(links.to(h) == before[around % 3 == 0 ? 0 : around % 3 == 1 ? 1 : 2]);
    ++around;
  });
  CHECK(around == 3);
}

TEST_CASE("drawing the middle of a split edge onto an end takes the split back") {
  const Mesh mesh = shapes::icosahedron();
  for (bool onto_start : {true, false}) {
    TriangleLinks links = links_of(mesh);
    const int m = middle_of(links);
    links.split(find(links, mesh.faces[5][1], mesh.faces[5][2]), m);
    links.collapse(find(links, m, mesh.faces[5][onto_start ? 1 : 2]));
    check_links(links);
    std::set<std::set<int>> faces, expected;
    for (const Triangle& t : mesh.faces) expected.insert({t[0], t[1], t[2]});
    for (const Triangle& t : links.faces)
      if (t[0] >= 0) faces.insert({t[0], t[1], t[2]});
    CHECK(faces == expected);
    CHECK(links.outgoing[m] == -1);
  }
}

TEST_CASE("any vertex inside can be drawn onto any neighbour that shares no others with it") {
  const Mesh mesh = shapes::grid(4, 4);
  const TriangleLinks whole = links_of(mesh);
  const Halfedges halfedges(mesh);
  std::vector<std::set<int>> neighbours(mesh.positions.size());
  for (const Triangle& t : mesh.faces)
    for (int a : t)
      for (int b : t)
        if (a != b) neighbours[a].insert(b);
  int apart = 0;
  for (int h = 0; h < static_cast<int>(whole.twin.size()); ++h) {
    const int v = whole.from(h), w = whole.to(h);
    if (halfedges.boundary_vertex(v)) continue;
    std::vector<int> shared;
    std::set_intersection(neighbours[v].begin(), neighbours[v].end(), neighbours[w].begin(), neighbours[w].end(),
                          std::back_inserter(shared));
    const bool expected = shared.size() == 2;
    CHECK(whole.ends_apart(h, halfedges.boundary_vertex(w)) == expected);
    if (!expected) continue;
    ++apart;
    TriangleLinks links = whole;
    links.collapse(h);
    check_links(links);
    CHECK(alive_faces(links) == mesh.face_count() - 2);
  }
  CHECK(apart > 20);
  // Of a tetrahedron with a vertex m in one face, the ends of that face's sides share the third corner besides m and
  // the fourth; all others share the corners of their two faces alone.
  TriangleLinks capped = links_of(shapes::tetrahedron());
  const Triangle face = capped.faces[0];
  capped.insert(0, middle_of(capped));
  const auto of_face = [&](int v) { return std::count(face.begin(), face.end(), v) > 0; };
  for (int h = 0; h < static_cast<int>(capped.twin.size()); ++h)
    CHECK(capped.ends_apart(h, false) == !(of_face(capped.from(h)) && of_face(capped.to(h))));
}

TEST_CASE("a vertex can be drawn onto the neighbours that see the whole ring") {
  const auto ends_of = [](const TriangleLinks& links, const std::vector<Complex>& at) {
    std::set<int> ends;
    const int along = links.collapsible(0, at[0], in_plane(links, at), [&](int h) {
      ends.insert(links.to(h));
      return false;
    });
    CHECK(along == -1);
    return ends;
  };
  const Mesh hexagonal = hexagon();
  const TriangleLinks six = links_of(hexagonal);
  const std::vector<Complex> regular = flat(hexagonal);
  CHECK(ends_of(six, regular) == std::set<int>{1, 2, 3, 4, 5, 6});
  const int along = six.collapsible(0, regular[0], in_plane(six, regular), [](int) { return true; });
  REQUIRE(along >= 0);
  CHECK(six.from(along) == 0);
  // An arrowhead with its tip at vertex 1, its barbs at 2 and 4, the notch between them at 3: a barb sees the other one
  // behind the notch.
  const TriangleLinks four = links_of(shapes::sector_disc(4, 0));
  CHECK(ends_of(four, {{0, 0}, {2, 0}, {-1, 1}, {-0.3, 0}, {-1, -1}}) == std::set<int>{1, 3});
}
