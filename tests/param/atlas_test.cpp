#include "param/atlas/atlas.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "mesh/error.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "small_maps.h"

using namespace gsp;

namespace {

constexpr int kLevel = 2;

Atlas quadrisected_atlas(const Mesh& base) { return atlas_of(exact_maps::quadrisected(base, kLevel)); }

}  // namespace

TEST_CASE("an atlas finishes to the map that it was read from") {
  for (const Mesh& base : {shapes::tetrahedron(), shapes::icosahedron(), shapes::grid(2, 2), shapes::torus(4, 3)}) {
    const Parameterization map = exact_maps::quadrisected(base, kLevel);
    const Atlas atlas = atlas_of(map);
    CHECK(atlas.broken_faces() == 0);
    const Parameterization again = atlas.finish({"method exact"});
    CHECK(check_map(again).valid());
    CHECK(again.patch == map.patch);
    CHECK(again.position == map.position);
    // A face's chart may be another one, but its shape in it is the same.
    for (int f = 0; f < map.surface.face_count(); ++f)
      for (int k = 0; k < 3; ++k)
        CHECK(std::abs(again.face_corners[f][(k + 1) % 3] - again.face_corners[f][k]) == Approx(0.25));
  }
}

TEST_CASE("a face between three patch corners that is one of the base's lies in its own chart") {
  for (const Mesh& base : {shapes::tetrahedron(), shapes::octahedron(), shapes::grid(2, 1)}) {
    const Atlas atlas = own_base(base);
    for (int f = 0; f < base.face_count(); ++f) {
      const Atlas::FaceFrame frame = atlas.face_frame(f);
      CHECK(frame.chart == f);
      const auto z = atlas.face_corners(f, frame);
      for (int k = 0; k < 3; ++k) CHECK(std::abs(z[k] - kChartCorners[k].value()) < 1e-15);
    }
  }
}

TEST_CASE("a vertex may have any chart: nothing moves, and it comes back to where it lies") {
  Random random(12);
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(3, 2)}) {
    const Atlas start = quadrisected_atlas(base);
    const std::vector<double> lengths = image_lengths(start);
    for (int v = 0; v < start.surface->mesh.vertex_count(); v += 3) {
      if (!start.is_free(v)) continue;
      Atlas atlas = start;
      int chart = atlas.patch[v];
      for (int step = 0; step < 3; ++step) {  // three base faces away
        const int h = 3 * chart + static_cast<int>(random.next() % 3);
        if (base_fans(atlas.base).empty() || atlas.base.twins[h] < 0) continue;
        const Transition across = atlas.base.across(h);
        chart = atlas.base.twins[h] / 3;
        atlas.change_chart(v, chart, across);
      }
      CHECK(atlas.broken_faces() == 0);
      CHECK(largest_change(lengths, image_lengths(atlas)) < 1e-12);
      CHECK(atlas.reassign(v));
      CHECK(inside_chart(atlas.position[v]));
      if (atlas.patch[v] == start.patch[v]) CHECK(std::abs(atlas.position[v] - start.position[v]) < 1e-12);
      CHECK(largest_change(lengths, image_lengths(atlas)) < 1e-12);
      CHECK(check_map(atlas.finish({})).valid());
    }
  }
}

TEST_CASE("vertices that wander across base edges get the chart where they come to lie") {
  Atlas atlas = quadrisected_atlas(shapes::octahedron());
  // Each vertex inside a patch, of which there are three, moves over the patch's first side: 0.35 up or down.
  std::vector<int> moved;
  for (int v = 0; v < atlas.surface->mesh.vertex_count(); ++v) {
    const auto w = chart_barycentric(atlas.position[v]);
    if (!atlas.is_free(v) || atlas.patch[v] != 3 || w[0] < 0.2 || w[1] < 0.2 || w[2] < 0.2) continue;
    moved.push_back(v);
    atlas.position[v] -= Complex(0.0, 0.01 + w[2] * kOmegaIm);
  }
  REQUIRE(moved.size() == 3);
  const std::vector<double> lengths = image_lengths(atlas);
  CHECK(atlas.reassign_all() == 0);
  const int neighbour = atlas.base.twins[9] / 3;
  for (int v : moved) {
    CHECK(atlas.patch[v] == neighbour);
    CHECK(inside_chart(atlas.position[v]));
    const Complex back = atlas.base.across(9).inverse().apply(atlas.position[v]);
    CHECK(back.imag() == Approx(-0.01));
  }
  CHECK(largest_change(lengths, image_lengths(atlas)) < 1e-12);
}

TEST_CASE("transitions that do not close up around a face are seen") {
  Atlas atlas = quadrisected_atlas(shapes::icosahedron());
  for (int e = 0; e < atlas.surface->edge_count(); ++e) {
    const int h = atlas.surface->edge_halfedge[e];
    const Halfedges& halfedges = atlas.surface->halfedges;
    const auto has_corner = [&](int half) {
      return atlas.corner[halfedges.from(half)] >= 0 || atlas.corner[halfedges.to(half)] >= 0 ||
             atlas.corner[halfedges.to(Halfedges::next(half))] >= 0;
    };
    const int faces = !has_corner(h) + !has_corner(halfedges.twin[h]);
    const Transition right = atlas.transition[e];
    atlas.transition[e] = Transition{0, {1, 0}} * right;
    CHECK(atlas.broken_faces() == faces);
    atlas.transition[e] = right;
  }
}

TEST_CASE("a map with a vertex in a patch far from its faces is refused") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 1);
  const int inside = 12;  // the middle of a base edge
  std::set<int> near;
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const Triangle& t = map.surface.faces[f];
    if (std::count(t.begin(), t.end(), inside) == 0) continue;
    near.insert(map.face_chart[f]);
    for (int h = 3 * map.face_chart[f]; h < 3 * map.face_chart[f] + 3; ++h) near.insert(map.base.twins[h] / 3);
  }
  int far = 0;
  while (near.count(far) > 0) ++far;
  map.patch[inside] = far;
  CHECK_THROWS_AS(atlas_of(map), Error);
}
