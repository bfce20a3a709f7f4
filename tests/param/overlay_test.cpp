#include <catch2/catch.hpp>
#include <memory>
#include <set>

#include "mesh/shapes.h"
#include "param/folds.h"
#include "param/overlay.h"
#include "param/simplify.h"

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
      SimplifyResult made = simplify(surface, options, progress);
      const Atlas fine = made.overlay.atlas(), coarse = std::move(made.overlay).coarsened().atlas;
      check_map_of(fine, c.mesh);
      check_map_of(coarse, c.mesh);
      CHECK(coarse.base.vertices == made.atlas.base.vertices);
      CHECK(coarse.base.faces == made.atlas.base.faces);
      CHECK(coarse.surface->mesh.vertex_count() <= fine.surface->mesh.vertex_count());
      if (4 * options.base_vertices > c.mesh.vertex_count()) break;
      options.base_vertices *= 4;
    }
  }
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
