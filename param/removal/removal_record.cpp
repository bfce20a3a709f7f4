#include "param/removal/removal_record.h"

namespace gsp {

CoarseSurface coarse_surface(const VertexMap& map) {
  const TriangleComplex& complex = map.complex();
  const Surface& fine = map.surface();
  CoarseSurface coarse;
  std::vector<int> number(fine.mesh.positions.size(), -1), valence(fine.mesh.positions.size(), 0);
  for (int t = 0; t < complex.slot_count(); ++t) {
    if (!complex.alive(t)) continue;
    coarse.slot.push_back(t);
    for (int v : complex.corners(t)) ++valence[v];
  }
  Mesh mesh;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (valence[v] == 0) continue;
    number[v] = mesh.vertex_count();
    mesh.positions.push_back(fine.mesh.positions[v]);
    coarse.vertex.push_back(static_cast<int>(v));
  }
  std::vector<double> areas;
  for (int t : coarse.slot) {
    const Triangle& c = complex.corners(t);
    mesh.faces.push_back({number[c[0]], number[c[1]], number[c[2]]});
    double area = 0.0;
    for (int v : c) area += fine.vertex_area[v] / valence[v];
    for (int v : map.points()[t]) area += fine.vertex_area[v];
    areas.push_back(area);
  }
  const auto surface = std::make_shared<Surface>(std::move(mesh), std::move(areas));
  surface->seams = fine.seams.of(coarse.vertex);
  coarse.surface = surface;
  return coarse;
}

void RemovalRecord::add(const Star& star, const std::vector<RingTriangle>& triangles) {
  centers_.push_back(star.center);
  ring_.insert(ring_.end(), star.ring.begin(), star.ring.end());
  slots_.insert(slots_.end(), star.triangles.begin(), star.triangles.end());
  if (star.boundary) slots_.push_back(-1);
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  first_.push_back(ring_.size());
}

void RemovalRecord::get(int removal, Star& star, std::vector<RingTriangle>& triangles) const {
  const std::size_t begin = first_[removal], end = first_[removal + 1];
  star.center = centers_[removal];
  star.boundary = slots_[end - 1] < 0;
  star.ring.assign(ring_.begin() + begin, ring_.begin() + end);
  star.triangles.assign(slots_.begin() + begin, slots_.begin() + end - star.boundary);
  triangles.assign(triangles_.begin() + (begin - 2 * removal), triangles_.begin() + (end - 2 * (removal + 1)));
}

}  // namespace gsp
