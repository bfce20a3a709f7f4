#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "param/atlas/folds.h"

namespace gsp {

/// Cones on a sphere, so that stars are flattened far from isometrically.
inline Mesh spiky_sphere(int level) {
  Mesh mesh = shapes::sphere(level);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 5) mesh.positions[v] *= 1.0 + 0.05 * double(v % 7);
  return mesh;
}

inline Mesh degenerate_sphere(int level) {
  Mesh mesh = shapes::sphere(level);
  for (std::size_t v = 0; v < 30; ++v) mesh.positions[v] = mesh.positions[0];
  return mesh;
}

struct Cut {
  const char* name;
  Mesh mesh;
  int base_vertices;
};

inline std::vector<Cut> cuts() {
  return {{"sphere", shapes::sphere(4), 4},
          {"torus", shapes::torus(30, 12), 12},
          {"plane", shapes::grid(16, 12), 6},
          {"spiky sphere", spiky_sphere(4), 12},
          {"degenerate sphere", degenerate_sphere(4), 12}};
}

inline double total_chart_area(const Atlas& atlas) {
  double sum = 0.0;
  for (int f = 0; f < atlas.surface->mesh.face_count(); ++f) {
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    sum += chart_area(z[0], z[1], z[2]);
  }
  return sum;
}

inline void check_map_of(const Atlas& atlas, const Mesh& mesh) {
  CHECK(find_folds(atlas).none());
  CHECK(atlas.broken_faces() == 0);
  CHECK(total_chart_area(atlas) == Approx(atlas.base.face_count() * kChartArea).epsilon(1e-11));
  // The same surface: its own vertices first, and the same area in pieces of its faces.
  for (int v = 0; v < mesh.vertex_count(); ++v) CHECK(atlas.surface->mesh.positions[v] == mesh.positions[v]);
  CHECK(surface_area(atlas.surface->mesh) == Approx(surface_area(mesh)).epsilon(1e-10));
}

}  // namespace gsp
