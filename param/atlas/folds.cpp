#include "param/atlas/folds.h"

#include <cmath>
#include <numbers>

#include "param/map/tolerances.h"

namespace gsp {

namespace {
double angle_at(const std::array<Complex, 3>& z, int k) {
  return std::abs(std::arg((z[(k + 2) % 3] - z[k]) * std::conj(z[(k + 1) % 3] - z[k])));
}

/// Wrong sums are off by full turns.
bool is_right_angle_sum(const Atlas& atlas, int vertex, double sum) {
  double expected = 2.0 * std::numbers::pi;
  if (atlas.corner[vertex] >= 0)
    expected = atlas.fans[atlas.corner[vertex]].valence() * std::numbers::pi / 3.0;
  else if (atlas.surface->halfedges.boundary_vertex(vertex))
    expected = std::numbers::pi;
  return std::abs(sum - expected) < 1.0;
}
}  // namespace

bool upright(Complex a, Complex b, Complex c) { return chart_area(a, b, c) > tolerance::kUprightArea; }

Folds find_folds(const Atlas& atlas) {
  const Surface& surface = *atlas.surface;
  Folds folds;
  // Round a vertex inside the surface the faces cover every direction once: those that cover one direction of its chart
  // are counted, one in which no edge is likely to lie, as many do along the edges of the chart. At corners and on
  // boundaries the angles are summed.
  const Complex direction = std::polar(1.0, 0.7231);
  std::vector<double> angle(atlas.patch.size(), 0.0);
  std::vector<int> turns(atlas.patch.size(), 0);
  std::vector<char> beside_fold(atlas.patch.size(), 0);
  const auto by_angle = [&](int v) { return atlas.corner[v] >= 0 || surface.halfedges.boundary_vertex(v); };
  for (int f = 0; f < surface.mesh.face_count(); ++f) {
    const Atlas::FaceFrame frame = atlas.face_frame(f);
    const auto z = atlas.face_corners(f, frame);
    const Triangle& t = surface.mesh.faces[f];
    if (!upright(z[0], z[1], z[2])) {
      folds.faces.push_back(f);
      for (int v : t) beside_fold[v] = 1;
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      if (by_angle(t[k])) {
        angle[t[k]] += angle_at(z, k);
        continue;
      }
      const Complex axis = omega_power(frame.to_chart[k].rotation) * direction;
      turns[t[k]] += cross(z[(k + 1) % 3] - z[k], axis) >= 0.0 && cross(axis, z[(k + 2) % 3] - z[k]) > 0.0;
    }
  }
  for (int v = 0; v < static_cast<int>(angle.size()); ++v) {
    if (atlas.patch[v] < 0 || beside_fold[v]) continue;
    if (by_angle(v) ? !is_right_angle_sum(atlas, v, angle[v]) : turns[v] != 1) folds.vertices.push_back(v);
  }
  return folds;
}

FoldRings rings_around(const Surface& surface, const Folds& folds, int most) {
  FoldRings rings;
  rings.distance.assign(surface.mesh.positions.size(), -1);
  const auto reach = [&](int v, int distance) {
    if (rings.distance[v] >= 0) return;
    rings.distance[v] = distance;
    rings.vertices.push_back(v);
  };
  for (int f : folds.faces)
    for (int v : surface.mesh.faces[f]) reach(v, 0);
  for (int v : folds.vertices) reach(v, 0);
  for (std::size_t i = 0; i < rings.vertices.size(); ++i) {
    const int v = rings.vertices[i], distance = rings.distance[v];
    if (distance < most) surface.for_each_neighbour(v, [&](int w, int, bool) { reach(w, distance + 1); });
  }
  return rings;
}

LocalMap local_map(const Atlas& atlas, int vertex) {
  double sum = 0.0;
  const int start = atlas.surface->halfedges.outgoing[vertex];
  int h = start;
  do {
    const auto z = atlas.face_corners(h / 3, atlas.face_frame(h / 3));
    if (!upright(z[0], z[1], z[2])) return LocalMap::Folded;
    sum += angle_at(z, h % 3);
    h = atlas.surface->halfedges.rotate_ccw(h);
  } while (h >= 0 && h != start);
  return is_right_angle_sum(atlas, vertex, sum) ? LocalMap::Injective : LocalMap::Miswound;
}

}  // namespace gsp
