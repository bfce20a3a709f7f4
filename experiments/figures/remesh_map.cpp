#include "experiments/figures/remesh_map.h"

#include <algorithm>
#include <numeric>

namespace gsp {

namespace {

/// Corners of the finest faces of one base face in its chart, in the order that `SubdivisionLevel` numbers them.
std::vector<std::array<Complex, 3>> chart_faces(int level) {
  std::vector<std::array<Complex, 3>> faces = {
      {kChartCorners[0].value(), kChartCorners[1].value(), kChartCorners[2].value()}};
  for (int l = 0; l < level; ++l) {
    std::vector<std::array<Complex, 3>> finer;
    finer.reserve(4 * faces.size());
    for (const auto& [a, b, c] : faces) {
      const Complex ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      for (const std::array<Complex, 3>& face :
           {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
        finer.push_back(face);
    }
    faces = std::move(finer);
  }
  return faces;
}

}  // namespace

Parameterization remesh_as_map(const SemiregularMesh& mesh) {
  Parameterization map;
  map.surface = mesh.mesh();
  map.base.vertices.resize(mesh.base_vertices);
  std::iota(map.base.vertices.begin(), map.base.vertices.end(), 0);
  map.base.faces = mesh.base_faces;
  map.base.creases = mesh.creases;
  map.base.connect();
  map.patch.assign(map.surface.positions.size(), -1);
  map.position.assign(map.surface.positions.size(), 0.0);
  const std::vector<std::array<Complex, 3>> corners = chart_faces(mesh.level);
  for (std::size_t f = 0; f < map.surface.faces.size(); ++f) {
    const int base_face = static_cast<int>(f / corners.size());
    map.face_chart.push_back(base_face);
    map.face_corners.push_back(corners[f % corners.size()]);
    for (int k = 0; k < 3; ++k) {
      map.patch[map.surface.faces[f][k]] = base_face;
      map.position[map.surface.faces[f][k]] = map.face_corners.back()[k];
    }
  }
  return map;
}

SemiregularMesh at_level(SemiregularMesh mesh, int level) {
  const std::vector<SubdivisionLevel> levels =
      subdivision_levels(mesh.base_vertices, mesh.base_faces, std::max(level, mesh.level));
  for (int l = mesh.level; l < level; ++l)
    for (const auto& [a, b] : levels[l].edges) mesh.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
  mesh.positions.resize(levels[level].vertex_count);
  mesh.level = level;
  return mesh;
}

}  // namespace gsp
