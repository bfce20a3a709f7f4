#include <catch2/catch.hpp>
#include <memory>
#include <set>

#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/atlas/split_edges.h"
#include "param/simplify/overlay.h"
#include "param/simplify/simplify.h"
#include "param/stages/smooth_levels.h"
#include "param_checks.h"

using namespace gsp;

namespace {

constexpr int kWhole = 1 << 30;  // as the coarsest level: the only one

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
      const Atlas maps = maps_of(made), fine = made.map->atlas();
      const Atlas coarse = std::move(*made.map).coarsened().atlas;
      check_map_of(fine, c.mesh);
      check_map_of(coarse, c.mesh);
      CHECK(coarse.base.vertices == maps.base.vertices);
      CHECK(coarse.base.faces == maps.base.faces);
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
  const Atlas maps = maps_of(made);
  const std::optional<SmoothedMap> smooth = smooth_levels(std::move(made), options, progress);
  REQUIRE(smooth);
  check_map_of(smooth->atlas, mesh);
  // Each triangle from its least vertex on, in the surface's numbers.
  const auto triangles = [](const BaseComplex& base) {
    std::set<Triangle> all;
    for (Triangle t : base.faces) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      all.insert(t);
    }
    return all;
  };
  CHECK(triangles(smooth->atlas.base) == triangles(maps.base));
}

TEST_CASE("a face that the simplification has left to the base has its own base face as its chart") {
  ParameterizeOptions options;
  options.base_vertices = 120;
  Progress progress;
  SimplifyResult made = simplify(std::make_shared<const Surface>(spiky_sphere(2)), options, kWhole, progress);
  const Parameterization map = std::move(*made.map).coarsened().atlas.finish({});
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
