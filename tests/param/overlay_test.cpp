#include <catch2/catch.hpp>
#include <memory>
#include <numeric>
#include <set>

#include "mesh/shapes.h"
#include "param/folds.h"
#include "param/overlay.h"
#include "param/simplify.h"
#include "param/smooth_levels.h"

using namespace gsp;

namespace {

/// Cones on a sphere, so that stars are flattened far from isometrically.
Mesh spiky_sphere(int level) {
  Mesh mesh = shapes::sphere(level);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 1.0 + 0.05 * double(v % 7);
  return mesh;
}

Mesh degenerate_sphere(int level) {
  Mesh mesh = shapes::sphere(level);
  for (std::size_t v = 0; v < 30; ++v) mesh.positions[v] = mesh.positions[0];
  return mesh;
}

struct Cut {
  const char* name;
  Mesh mesh;
  int base_vertices;
};

std::vector<Cut> cuts() {
  return {{"sphere", shapes::sphere(4), 4},           {"torus", shapes::torus(30, 12), 12},
          {"plane", shapes::grid(16, 12), 6},        {"spiky sphere", spiky_sphere(4), 12},
          {"degenerate sphere", degenerate_sphere(4), 12}};
}

double total_chart_area(const Atlas& atlas) {
  double sum = 0.0;
  for (int f = 0; f < atlas.surface->mesh.face_count(); ++f) {
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    sum += chart_area(z[0], z[1], z[2]);
  }
  return sum;
}

void check_map_of(const Atlas& atlas, const Mesh& mesh) {
  CHECK(find_folds(atlas).none());
  CHECK(atlas.broken_faces() == 0);
  CHECK(total_chart_area(atlas) == Approx(atlas.base.face_count() * kChartArea).epsilon(1e-11));
  // The same surface: its own vertices first, and the same area in pieces of its faces.
  for (int v = 0; v < mesh.vertex_count(); ++v) CHECK(atlas.surface->mesh.positions[v] == mesh.positions[v]);
  CHECK(surface_area(atlas.surface->mesh) == Approx(surface_area(mesh)).epsilon(1e-10));
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
      SimplifyResult made = simplify(surface, options, 1, progress);
      const Atlas maps = maps_of(made), fine = made.levels.back().atlas();
      const Atlas coarse = std::move(made.levels.back()).coarsened().atlas;
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

TEST_CASE("a map onto a complex followed by one of the complex is a map free of folds onto the base of the second") {
  for (Cut& c : cuts()) {
    INFO(c.name);
    split_boundary_chords(c.mesh);
    for (int ratio : {2, 6}) {
      INFO(ratio);
      Progress progress;
      ParameterizeOptions options;
      options.base_vertices = std::max(c.base_vertices, c.mesh.vertex_count() / ratio);
      SimplifyResult first = simplify(std::make_shared<const Surface>(c.mesh), options, 1, progress);
      const CoarseSurface complex = coarse_surface(first.levels.back());
      CHECK(std::accumulate(complex.surface->face_area.begin(), complex.surface->face_area.end(), 0.0) ==
            Approx(surface_area(c.mesh)).epsilon(1e-12));
      options.base_vertices = c.base_vertices;
      SimplifyResult second = simplify(complex.surface, options, 1, progress);
      const RefinedMap coarse = std::move(second.levels.back()).coarsened();
      const std::optional<RefinedMap> whole = std::move(first.levels.back()).followed_by(coarse);
      REQUIRE(whole);
      check_map_of(whole->atlas, c.mesh);
      CHECK(whole->atlas.base.faces == coarse.atlas.base.faces);
      // Where the complex has a vertex, the two maps agree.
      for (std::size_t v = 0; v < complex.vertex.size(); ++v) {
        const int there = complex.vertex[v];
        CHECK(whole->atlas.corner[there] == coarse.atlas.corner[v]);
        if (whole->atlas.patch[there] == coarse.atlas.patch[v])
          CHECK(std::abs(whole->atlas.position[there] - coarse.atlas.position[v]) < 1e-12);
      }
    }
  }
}

TEST_CASE("the levels of a simplification together make the same base as their removals") {
  Mesh mesh = shapes::sphere(5);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 1.0 + 0.01 * double(v % 7);
  const auto surface = std::make_shared<const Surface>(mesh);
  ParameterizeOptions options;
  options.base_vertices = 20;
  Progress progress;
  SimplifyResult made = simplify(surface, options, 3, progress);
  REQUIRE(made.levels.size() == 2);
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
  SimplifyResult made = simplify(std::make_shared<const Surface>(spiky_sphere(2)), options, 1, progress);
  const Parameterization map = std::move(made.levels.back()).coarsened().atlas.finish({});
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
