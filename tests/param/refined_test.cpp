#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/refined/coarsen.h"
#include "param/refined/editable_atlas.h"
#include "param/refined/refined_surface.h"
#include "small_maps.h"

using namespace gsp;

namespace {

using CornerWeights = std::array<double, 3>;

Vec3 place_of(const RefinedSurface& refined, int v, int face) {
  const Mesh& mesh = refined.original().mesh;
  const CornerWeights w = refined.weights_in(v, face);
  return w[0] * mesh.positions[mesh.faces[face][0]] + w[1] * mesh.positions[mesh.faces[face][1]] +
         w[2] * mesh.positions[mesh.faces[face][2]];
}

int find(const RefinedSurface& refined, int from, int to) {
  for (int h = 0; h < 3 * refined.face_slots(); ++h)
    if (refined.alive(h / 3) && refined.from(h) == from && refined.to(h) == to) return h;
  return -1;
}

/// Cuts a map's surface at the middle of the edge of h, and leaves the map as it is.
void split_in_half(RefinedSurface& refined, LooseMap& loose, int h) {
  const int twin = refined.twin(h), b = refined.to(h);
  const int c = refined.from(Halfedges::prev(h));
  // Everything in the chart of the half-edge's start, which must be no patch corner.
  const Transition at_b = loose.transition[h], at_c = loose.transition[Halfedges::prev(h)].inverse(),
                   at_d = loose.transition[Halfedges::next(twin)];
  const Transition b_to_c = loose.transition[Halfedges::next(h)], a_to_d = at_d;
  const int a = refined.from(h);
  const auto into = [&](int v) { return v == a ? Transition{} : v == b ? at_b : v == c ? at_c : at_d; };
  const Complex middle = 0.5 * (loose.position[a] + at_b.apply(loose.position[b]));
  const int chart = loose.patch[a], m = refined.split(h, 0.5);
  loose.patch.push_back(chart);
  loose.corner.push_back(-1);
  loose.position.push_back(middle);
  loose.transition.resize(3 * static_cast<std::size_t>(refined.face_slots()));
  for (int f : {h / 3, twin / 3, refined.face_slots() - 2, refined.face_slots() - 1})
    for (int k = 3 * f; k < 3 * f + 3; ++k) {
      if (refined.from(k) == m) loose.transition[k] = into(refined.to(k));
      if (refined.to(k) == m) loose.transition[k] = into(refined.from(k)).inverse();
    }
  // The sides that the new faces took over keep what they had.
  loose.transition[3 * refined.face_slots() - 5] = b_to_c;
  loose.transition[3 * refined.face_slots() - 2] = a_to_d;
}

}  // namespace

TEST_CASE("vertices know where they lie by the faces that hold them") {
  const Mesh mesh = shapes::sphere(1);
  RefinedSurface refined(std::make_shared<const Surface>(mesh));
  const int a = mesh.faces[7][0], b = mesh.faces[7][1], c = mesh.faces[7][2];
  const Vec3 at_a = mesh.positions[a], at_b = mesh.positions[b], at_c = mesh.positions[c];
  // On an edge, then on one of the halves, then inside a piece.
  const int m = refined.split(find(refined, a, b), 0.25), n = refined.split(find(refined, m, b), 0.5);
  CHECK((place_of(refined, m, 7) - (0.75 * at_a + 0.25 * at_b)).norm() < 1e-15);
  CHECK((place_of(refined, n, 7) - (0.375 * at_a + 0.625 * at_b)).norm() < 1e-15);
  const int beyond = refined.origin(refined.twin(find(refined, a, m)) / 3);
  CHECK(beyond != 7);
  CHECK((place_of(refined, m, beyond) - place_of(refined, m, 7)).norm() < 1e-15);
  const int piece = find(refined, m, n) / 3;
  REQUIRE(refined.origin(piece) == 7);
  const Triangle t = refined.corners(piece);
  const int inside = refined.insert(piece, {0.5, 0.3, 0.2});
  Vec3 expected = Vec3::Zero();
  const CornerWeights w = {0.5, 0.3, 0.2};
  for (int k = 0; k < 3; ++k) expected += w[k] * place_of(refined, t[k], 7);
  CHECK((place_of(refined, inside, 7) - expected).norm() < 1e-15);
  CHECK(refined.weights_in(c, 7) == CornerWeights{0, 0, 1});
  // Whole again in the compact form: every piece upright in its face.
  const RefinedSurface::Compact compact = refined.compact();
  CHECK(compact.mesh.vertex_count() == mesh.vertex_count() + 3);
  CHECK(compact.mesh.face_count() == mesh.face_count() + 6);
  CHECK(surface_area(compact.mesh) == Approx(surface_area(mesh)));
  CHECK((compact.mesh.positions[compact.vertex[n]] - (0.375 * at_a + 0.625 * at_b)).norm() < 1e-15);
  CHECK((at_c - compact.mesh.positions[c]).norm() == 0.0);
}

TEST_CASE("a snapshot takes splits back") {
  const Mesh mesh = shapes::icosahedron();
  RefinedSurface refined(std::make_shared<const Surface>(mesh));
  refined.split(3, 0.5);
  std::vector<int> faces(refined.face_slots()), vertices(refined.vertex_count());
  std::iota(faces.begin(), faces.end(), 0);
  std::iota(vertices.begin(), vertices.end(), 0);
  const RefinedSurface::Snapshot before = refined.snapshot(faces, vertices);
  const TriangleLinks links = refined.links();
  for (int h : {0, 13, 30, 41}) refined.split(h, 0.3);
  refined.restore(before);
  CHECK(refined.vertex_count() == 13);
  CHECK(refined.links().faces == links.faces);
  CHECK(refined.links().twin == links.twin);
  CHECK(refined.links().outgoing == links.outgoing);
}

TEST_CASE("an added vertex on an edge may be drawn along it only") {
  const Mesh mesh = shapes::icosahedron();
  RefinedSurface refined(std::make_shared<const Surface>(mesh));
  const int a = refined.from(10), b = refined.to(10);
  const int m = refined.split(10, 0.4);
  std::vector<int> ends;
  refined.for_each_outgoing(m, [&](int h) {
    if (refined.can_collapse(h)) ends.push_back(refined.to(h));
  });
  std::sort(ends.begin(), ends.end());
  CHECK(ends == std::vector<int>{std::min(a, b), std::max(a, b)});
  for (int h = 0; h < 60; ++h)  // original vertices stay
    if (refined.from(h) != m) CHECK_FALSE(refined.can_collapse(h));
}

TEST_CASE("a map loosened and tightened is the same map") {
  for (const Mesh& base : {shapes::octahedron(), shapes::grid(2, 2)}) {
    EditableAtlas map = untouched(atlas_of(exact_maps::quadrisected(base, 2)));
    const Atlas before = map.atlas;
    const LooseMap loose = loosen(map);
    const EditableAtlas after = tighten(map.refined, loose, map.atlas.base, map.atlas.fans);
    CHECK(after.atlas.patch == before.patch);
    CHECK(after.atlas.corner == before.corner);
    CHECK(after.atlas.position == before.position);
    CHECK(after.atlas.transition == before.transition);
    CHECK(after.atlas.surface->mesh.faces == before.surface->mesh.faces);
    // By half-edges it says the same: where the other corners of a face lie.
    for (int h = 0; h < 3 * before.surface->mesh.face_count(); ++h) {
      const int v = before.surface->halfedges.from(h);
      if (before.corner[v] >= 0) continue;
      const auto [x, y] = loose.link(map.refined.links(), h);
      CHECK(std::abs(x - loose.position[v]) == Approx(0.25));
      CHECK(std::abs(y - loose.position[v]) == Approx(0.25));
      CHECK(std::arg((y - loose.position[v]) / (x - loose.position[v])) == Approx(std::acos(0.5)));
    }
  }
}

TEST_CASE("a patch that is cut across is drawn together again, and the map is what it was") {
  EditableAtlas map = untouched(atlas_of(exact_maps::quadrisected(shapes::icosahedron(), 2)));
  const std::vector<double> lengths = image_lengths(map.atlas);
  LooseMap loose = loosen(map);
  int cuts = 0;
  for (int h = 0; h < 900; h += 41) {
    const TriangleLinks& links = map.refined.links();
    if (h >= 3 * map.refined.face_slots() || loose.corner[links.from(h)] >= 0) continue;
    split_in_half(map.refined, loose, h);
    ++cuts;
  }
  REQUIRE(cuts > 10);
  EditableAtlas cut = tighten(std::move(map.refined), loose, map.atlas.base, map.atlas.fans);
  CHECK(cut.atlas.surface->mesh.vertex_count() == 162 + cuts);
  CHECK(cut.atlas.reassign_all() == 0);
  CHECK(check_map(cut.atlas.finish({})).valid());
  const EditableAtlas whole = coarsen(std::move(cut));
  CHECK(whole.atlas.surface->mesh.vertex_count() == 162);
  CHECK(whole.atlas.surface->mesh.face_count() == 320);
  CHECK(check_map(whole.atlas.finish({})).valid());
  std::vector<double> before = lengths, after = image_lengths(whole.atlas);
  CHECK(largest_change(before, after) < 1e-12);
}
