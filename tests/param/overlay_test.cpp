#include <catch2/catch.hpp>
#include <memory>
#include <set>

#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/atlas/split_edges.h"
#include "param/baselines/maps.h"
#include "param/simplify/overlay.h"
#include "param/simplify/simplify.h"
#include "param/stages/smooth_levels.h"
#include "param_checks.h"

using namespace gsp;

namespace {

Triangle from_least(Triangle t) {
  while (t[0] > std::min(t[1], t[2])) t = {t[1], t[2], t[0]};
  return t;
}

constexpr int kWhole = 1 << 30;  // as the coarsest level: the only one

/// The triangles that the removals leave, by the surface's vertices, each from its least one on.
std::set<Triangle> remaining_triangles(const Surface& surface, const RemovalScript& removals) {
  TriangleComplex complex(surface);
  Star star;
  Removal removal;
  std::vector<int> slots;
  for (int i = 0; i < removals.size(); ++i) {
    complex.gather(removals.vertex(i), star);
    removals.place(i, star, removal);
    complex.replace(star, removal.triangles, slots);
  }
  std::set<Triangle> all;
  for (int t = 0; t < complex.slot_count(); ++t)
    if (complex.alive(t)) all.insert(from_least(complex.corners(t)));
  return all;
}

std::set<Triangle> base_triangles(const BaseComplex& base) {
  std::set<Triangle> all;
  for (const Triangle& t : base.faces)
    all.insert(from_least({base.vertices[t[0]], base.vertices[t[1]], base.vertices[t[2]]}));
  return all;
}

}  // namespace

TEST_CASE("the map is free of folds after every removal, whatever the surface") {
  for (Cut& c : cuts()) {
    INFO(c.name);
    split_boundary_chords(c.mesh);
    const auto surface = std::make_shared<const Surface>(c.mesh);
    ParameterizeOptions options;
    options.base_vertices = c.base_vertices;
    while (true) {
      Progress progress;
      SimplifyResult made = simplify(surface, options, kWhole, progress);
      const Atlas fine = made.map->atlas(), coarse = made.map->coarsened().atlas;
      check_map_of(fine, c.mesh);
      check_map_of(coarse, c.mesh);
      CHECK(coarse.base.vertices == fine.base.vertices);
      CHECK(base_triangles(coarse.base) == remaining_triangles(*surface, made.removals));
      CHECK(coarse.surface->mesh.vertex_count() <= fine.surface->mesh.vertex_count());
      if (4 * options.base_vertices > c.mesh.vertex_count()) break;
      options.base_vertices *= 4;
    }
  }
}

TEST_CASE("the levels of a simplification together make the same base as their removals") {
  Mesh mesh = shapes::sphere(5);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 1.0 + 0.01 * double(v % 7);
  const auto surface = std::make_shared<const Surface>(mesh);
  ParameterizeOptions options;
  options.base_vertices = 20;
  options.base_edges = BaseEdges::Keep;
  Progress progress;
  SimplifyResult made = simplify(surface, options, coarsest_level(*surface, options), progress);
  REQUIRE(made.finer.size() == 2);
  CHECK(remaining_vertices(*surface, made.removals).size() == 20);
  const std::optional<OverlayMap> overlay = maps_overlay(made);
  REQUIRE(overlay);
  const Atlas maps = overlay->coarsened().atlas;
  check_map_of(maps, mesh);
  CHECK(base_triangles(maps.base) == remaining_triangles(*surface, made.removals));
  const std::optional<SmoothedMap> smooth = smooth_levels(made, options, progress);
  REQUIRE(smooth);
  check_map_of(smooth->atlas, mesh);
  // Its corners have moved.
  const auto numbers = [](const BaseComplex& base) {
    std::set<Triangle> all;
    for (const Triangle& t : base.faces) all.insert(from_least(t));
    return all;
  };
  CHECK(numbers(smooth->atlas.base) == numbers(maps.base));
}

TEST_CASE("a face that the simplification has left to the base has its own base face as its chart") {
  ParameterizeOptions options;
  options.base_vertices = 120;
  Progress progress;
  SimplifyResult made = simplify(std::make_shared<const Surface>(spiky_sphere(2)), options, kWhole, progress);
  const Parameterization map = made.map->coarsened().atlas.finish({});
  CHECK(check_map(map).valid());
  std::vector<int> corner(map.surface.positions.size(), -1);
  for (int b = 0; b < map.base.vertex_count(); ++b) corner[map.base.vertices[b]] = b;
  int left = 0;
  for (int f = 0; f < map.surface.face_count(); ++f) {
    std::set<int> corners;
    for (int v : map.surface.faces[f]) corners.insert(corner[v]);
    const bool in_base = std::any_of(map.base.faces.begin(), map.base.faces.end(),
                                     [&](const Triangle& t) { return std::set<int>(t.begin(), t.end()) == corners; });
    if (!in_base) continue;
    ++left;
    const Triangle& chart = map.base.faces[map.face_chart[f]];
    CHECK(std::set<int>(chart.begin(), chart.end()) == corners);
  }
  CHECK(left > 20);
}

TEST_CASE("a face cut to pieces comes back whole when the cuts are drawn together") {
  const Mesh mesh = shapes::sphere(1);
  RefinedSurface refined(std::make_shared<const Surface>(mesh));
  for (int h : {0, 4, 20, 55}) refined.split(h, 0.3);
  for (int h = 3 * mesh.face_count(); h < 3 * mesh.face_count() + 9; h += 2) refined.split(h, 0.6);
  CHECK(refined.compact().mesh.vertex_count() == mesh.vertex_count() + 9);
  CHECK(surface_area(refined.compact().mesh) == Approx(surface_area(mesh)).epsilon(1e-12));
  for (int pass = 0; pass < 4; ++pass)
    for (int v = mesh.vertex_count(); v < refined.vertex_count(); ++v) {
      int along = -1;
      refined.for_each_outgoing(v, [&](int h) {
        if (refined.can_collapse(h)) along = h;
      });
      if (along >= 0) refined.collapse(along);
    }
  const RefinedSurface::Compact whole = refined.compact();
  CHECK(whole.mesh.positions == mesh.positions);
  REQUIRE(whole.mesh.face_count() == mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    CHECK(std::set<int>(whole.mesh.faces[f].begin(), whole.mesh.faces[f].end()) ==
          std::set<int>(mesh.faces[f].begin(), mesh.faces[f].end()));
}
