#include "param/reinsert/star_hole.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/reinsert/insert_by_cutting.h"
#include "param/reinsert/reinsertion.h"
#include "param/reinsert/reinsertion_map.h"
#include "small_maps.h"

using namespace gsp;

namespace {

/// A map of a coarse surface, known exactly, and the removal of one vertex that led there: it lay in the middle of a
/// polygon of the coarse surface's faces, or of a side of it on the boundary.
struct OneOut {
  Mesh fine;
  RemovalRecord record;
  EditableAtlas map;
};

/// The corners of a region of faces that turn about a vertex, counter-clockwise; where `along` is set, from one on such
/// that the last and the first bound a face on the boundary.
std::vector<int> outline(const Mesh& mesh, const std::vector<int>& faces, bool along) {
  std::map<int, int> next;
  std::set<std::pair<int, int>> sides, all;
  for (int f : faces)
    for (int k = 0; k < 3; ++k) sides.insert({mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]});
  for (const Triangle& t : mesh.faces)
    for (int k = 0; k < 3; ++k) all.insert({t[k], t[(k + 1) % 3]});
  int start = -1;
  for (const auto& [a, b] : sides) {
    if (sides.count({b, a}) > 0) continue;
    next[a] = b;
    if (start < 0 && (!along || all.count({b, a}) == 0)) start = along ? b : a;
  }
  std::vector<int> polygon;
  if (start < 0) return polygon;
  for (int at = start; polygon.empty() || at != start; at = next[at]) polygon.push_back(at);
  return polygon;
}

/// The map of `record.coarse` that `exact` is, whose faces are the same in another order.
Atlas coarse_atlas(const Parameterization& exact, const RemovalRecord& record) {
  std::map<Triangle, int> face;
  for (int f = 0; f < exact.surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Triangle& t = exact.surface.faces[f];
      face[{t[k], t[(k + 1) % 3], t[(k + 2) % 3]}] = 3 * f + k;
    }
  Parameterization map = exact;
  map.surface = record.coarse.surface->mesh;
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const int from = face.at(map.surface.faces[f]);
    map.face_chart[f] = exact.face_chart[from / 3];
    for (int k = 0; k < 3; ++k) map.face_corners[f][k] = exact.face_corners[from / 3][(from % 3 + k) % 3];
  }
  Atlas atlas = atlas_of(map);
  atlas.surface = record.coarse.surface;
  return atlas;
}

/// `around`: the vertex that the faces to be replaced turn about. Its corners become a fan from that vertex again when
/// the new vertex, the last one, goes out.
OneOut one_out(const Parameterization& exact, int around, int count, bool boundary) {
  const Mesh& coarse = exact.surface;
  const Halfedges halfedges(coarse);
  std::vector<int> fan;
  for (int h = halfedges.outgoing[around]; h >= 0 && static_cast<int>(fan.size()) < count; h = halfedges.rotate_ccw(h))
    fan.push_back(h / 3);
  const std::vector<int> polygon = outline(coarse, fan, boundary);
  REQUIRE(static_cast<int>(polygon.size()) == count + 2);
  Mesh fine;
  fine.positions = coarse.positions;
  const int n = count + 2, v = coarse.vertex_count();
  Vec3 middle = Vec3::Zero();
  for (int p : polygon) middle += coarse.positions[p] / n;
  if (boundary) middle = (coarse.positions[polygon.front()] + coarse.positions[polygon.back()]) / 2;
  fine.positions.push_back(middle);
  for (int f = 0; f < coarse.face_count(); ++f)
    if (std::count(fan.begin(), fan.end(), f) == 0) fine.faces.push_back(coarse.faces[f]);
  for (int k = 0; k < n - boundary; ++k) fine.faces.push_back({v, polygon[k], polygon[(k + 1) % n]});

  OneOut made{fine, {}, {RefinedSurface(std::make_shared<const Surface>(shapes::tetrahedron())), {}, {}, {}}};
  const auto surface = std::make_shared<const Surface>(fine);
  VertexMap shrinking(surface);
  Star star;
  shrinking.complex().gather(v, star);
  const int from = static_cast<int>(std::find(star.ring.begin(), star.ring.end(), around) - star.ring.begin());
  Removal removal{v, {}};
  for (int k = 1; k + 1 < n; ++k) {
    RingTriangle t{from, (from + k) % n, (from + k + 1) % n};
    std::sort(t.begin(), t.end());
    removal.triangles.push_back(t);
  }
  made.record.surface = surface;
  made.record.add(star, removal.triangles);
  shrinking.remove(removal);
  made.record.coarse = coarse_surface(shrinking);
  made.map = untouched(coarse_atlas(exact, made.record));
  return made;
}

/// Every hole that the cases of a surface have: of each ring's size, beside a patch corner or not, on the boundary.
template <class Visit>
void for_each_hole(Visit visit) {
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(2, 2), shapes::lattice_torus(4, 3)})
    for (int level : {0, 2}) {
      const Parameterization exact = exact_maps::quadrisected(base, level);
      const Halfedges halfedges(exact.surface);
      std::set<std::array<int, 3>> done;  // count, whether about a corner, whether on the boundary
      for (int v = 0; v < exact.surface.vertex_count(); ++v) {
        int valence = 0;
        for (int h = halfedges.outgoing[v]; h >= 0; h = halfedges.rotate_ccw(h))
          if (++valence > 1 && halfedges.rotate_ccw(h) == halfedges.outgoing[v]) break;
        const bool boundary = halfedges.boundary_vertex(v);
        for (int count = 1; count < valence + boundary; ++count) {
          if (!done.insert({count, v < base.vertex_count(), boundary}).second) continue;
          INFO("base of " << base.face_count() << " faces, level " << level << ", ring of " << count + 2 << " about "
                          << v << (boundary ? ", on the boundary" : ""));
          const OneOut made = one_out(exact, v, count, boundary);
          visit(made, count, boundary);
        }
      }
    }
}

std::vector<int> all_faces(const TriangleLinks& links) {
  std::vector<int> faces;
  for (int f = 0; f < static_cast<int>(links.faces.size()); ++f)
    if (links.alive(f)) faces.push_back(f);
  return faces;
}

}  // namespace

TEST_CASE("the hole of a removed vertex is its star's ring and the faces that fill it") {
  for_each_hole([](const OneOut& made, int count, bool boundary) {
    ReinsertionMap growing(made.record, made.map);
    StarHole hole(growing);
    REQUIRE(hole.open(0));
    CHECK(static_cast<int>(hole.region.size()) == count);
    REQUIRE(hole.border.size() == hole.star.ring.size());
    for (int k = 0; k < hole.star.size(); ++k) {
      const StarHole::Side& side = hole.border[k];
      CHECK(side.vertex == hole.star.ring[k]);
      CHECK(hole.side_of_ring[k] == k);
      CHECK(std::abs(hole.in_plane(hole.star.ring[k]) - hole.ring[k]) < 1e-15);
      if (side.halfedge < 0) {
        CHECK(boundary);
        CHECK(k + 1 == hole.star.size());
        continue;
      }
      CHECK(growing.links.from(side.halfedge) == hole.star.ring[k]);
      CHECK(growing.links.to(side.halfedge) == hole.star.ring[(k + 1) % hole.star.size()]);
      CHECK(hole.holds(side.halfedge / 3));
      CHECK(hole.is_side(side.halfedge));
      CHECK(side.slot == hole.star.triangles[k]);
    }
    for (int f : hole.region) CHECK(growing.links.alive(f));
    if (boundary) CHECK(hole.share_of_boundary() == Approx(0.5));
    // A ring around the hole: all faces that share a vertex with it.
    std::set<int> corners, expected;
    for (int f : hole.region) corners.insert(growing.links.faces[f].begin(), growing.links.faces[f].end());
    for (int f : all_faces(growing.links))
      for (int w : growing.links.faces[f])
        if (corners.count(w) > 0) expected.insert(f);
    CHECK(hole.faces_within(1) == std::vector<int>(expected.begin(), expected.end()));
  });
}

TEST_CASE("a vertex cut into its hole moves nothing: the map stays free of folds, its pieces make up its star") {
  for_each_hole([](const OneOut& made, int, bool) {
    ReinsertionMap growing(made.record, made.map);
    StarHole hole(growing);
    REQUIRE(hole.open(0));
    REQUIRE(cut_in(hole));
    EditableAtlas whole = std::move(growing).finish();
    CHECK(whole.atlas.reassign_all() == 0);
    CHECK(check_map(whole.atlas.finish({})).valid());
    CHECK(surface_area(whole.atlas.surface->mesh) == Approx(surface_area(made.fine)));
    for (int v = 0; v < made.fine.vertex_count(); ++v)
      CHECK(whole.atlas.surface->mesh.positions[v] == made.fine.positions[v]);
    // Vertices that were there before have not moved.
    for (int v = 0; v < made.map.atlas.surface->mesh.vertex_count(); ++v)
      if (whole.atlas.patch[v] == made.map.atlas.patch[v])
        CHECK(std::abs(whole.atlas.position[v] - made.map.atlas.position[v]) < 1e-12);
  });
}

TEST_CASE("a vertex put back where it sees the border leaves the surface's own faces alone") {
  int whole_faces = 0;
  for_each_hole([&](const OneOut& made, int, bool) {
    std::optional<EditableAtlas> back = reinsert(made.record, made.map);
    REQUIRE(back);
    CHECK(back->atlas.reassign_all() == 0);
    CHECK(check_map(back->atlas.finish({})).valid());
    const Mesh& mesh = back->atlas.surface->mesh;
    if (mesh.vertex_count() > made.fine.vertex_count()) return;
    ++whole_faces;
    CHECK(mesh.faces == made.fine.faces);
  });
  CHECK(whole_faces > 30);
}

TEST_CASE("splitting an edge or a face of a growing map leaves the map what it is") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(2, 2)}) {
    const Parameterization exact = exact_maps::quadrisected(base, 1);
    const OneOut made = one_out(exact, exact.surface.vertex_count() - 1, 2, false);
    ReinsertionMap growing(made.record, made.map);
    CHECK(growing.own_vertices() == made.fine.vertex_count());
    const double area = exact.surface.face_count() * kChartArea / 4;
    for (int step = 0; step < 12; ++step) {
      const int h = (37 * step) % static_cast<int>(growing.links.twin.size());
      const int m = growing.add_vertex();
      CHECK(growing.is_added(m));
      if (step % 2 == 0)
        REQUIRE(growing.split(h, 0.375, m));
      else
        growing.insert(h / 3, {0.25, 0.5, 0.25}, m);
      // Its place on the surface is not asked for here; any will do.
      growing.added[m - growing.own_vertices()] = {{0, 1, 2}, {1.0, 0.0, 0.0}};
      CHECK(growing.on_surface(m) == made.fine.positions[0]);
    }
    std::vector<int> vertices;
    const Atlas whole = growing.part(all_faces(growing.links), vertices);
    CHECK(whole.broken_faces() == 0);
    double sum = 0.0;
    for (int f = 0; f < whole.surface->mesh.face_count(); ++f) {
      const auto z = whole.face_corners(f, whole.face_frame(f));
      CHECK(chart_area(z[0], z[1], z[2]) > 0.0);
      sum += chart_area(z[0], z[1], z[2]);
    }
    CHECK(sum == Approx(area));
    CHECK(find_folds(whole).none());
  }
}

TEST_CASE("the base face at a boundary edge between two patch corners is found from any chart") {
  const Mesh base = shapes::grid(3, 2);
  const OneOut made = one_out(exact_maps::quadrisected(base, 0), 5, 1, false);
  const ReinsertionMap growing(made.record, made.map);
  const BaseComplex& complex = growing.base;
  for (int h = 0; h < static_cast<int>(complex.twins.size()); ++h) {
    const int f = h / 3, next = Halfedges::next(h) % 3;
    const int from = growing.decimation.coarse.vertex[complex.vertices[complex.faces[f][h % 3]]];
    const int to = growing.decimation.coarse.vertex[complex.vertices[complex.faces[f][next]]];
    // In a chart that is turned and shifted against the face's own.
    const Transition other{2, {3, -1}};
    const auto seat = growing.boundary_seat(from, to, other.apply(kChartCorners[h % 3].value()),
                                            other.apply(kChartCorners[next].value()));
    CHECK(seat.has_value() == (complex.twins[h] < 0));
    if (!seat) continue;
    CHECK(seat->chart == f);
    CHECK(seat->change == other.inverse());
  }
}
