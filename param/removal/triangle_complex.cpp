#include "param/removal/triangle_complex.h"

#include <algorithm>
#include <cassert>

namespace gsp {

TriangleComplex::TriangleComplex(const Surface& surface)
    : slots_(surface.mesh.faces.size()),
      incident_(surface.mesh.positions.size(), -1),
      seams_(surface.seams),
      copies_(surface.seams.points) {
  for (std::size_t f = 0; f < slots_.size(); ++f) {
    slots_[f].corners = surface.mesh.faces[f];
    for (int k = 0; k < 3; ++k) {
      const int twin = surface.halfedges.twin[3 * f + k];
      slots_[f].neighbours[k] = twin < 0 ? -1 : twin / 3;
    }
  }
  for (std::size_t v = 0; v < incident_.size(); ++v)
    if (surface.halfedges.outgoing[v] >= 0) incident_[v] = surface.halfedges.outgoing[v] / 3;
  for (std::size_t v = 0; v < seams_.point.size(); ++v)
    if (seams_.point[v] >= 0) copies_[seams_.point[v]].push_back(static_cast<int>(v));
  label_components(surface);
}

void TriangleComplex::label_components(const Surface& surface) {
  const int count = surface.mesh.vertex_count();
  component_.assign(count, -1);
  loop_.assign(count, -1);
  std::vector<int> stack;
  for (int seed = 0; seed < count; ++seed) {
    if (incident_[seed] < 0 || component_[seed] >= 0) continue;
    const int label = static_cast<int>(component_size_.size());
    component_size_.push_back(0);
    component_[seed] = label;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      const auto reach = [&](int w) {
        if (component_[w] >= 0) return;
        component_[w] = label;
        stack.push_back(w);
      };
      const int point = seams_.point_of(v);
      component_size_[label] += point < 0 || copies_[point].front() == v;
      surface.for_each_neighbour(v, [&](int w, int, bool) { reach(w); });
      if (point >= 0) std::for_each(copies_[point].begin(), copies_[point].end(), reach);
    }
  }
  for (int seed = 0; seed < count; ++seed) {
    if (loop_[seed] >= 0 || !surface.halfedges.boundary_vertex(seed)) continue;
    loop_size_.push_back(0);
    for (int v = seed; loop_[v] < 0; v = surface.halfedges.to(surface.halfedges.outgoing[v])) {
      loop_[v] = static_cast<int>(loop_size_.size()) - 1;
      ++loop_size_.back();
    }
  }
}

int TriangleComplex::edge_towards(int triangle, int other) const {
  for (int k = 0; k < 3; ++k)
    if (slots_[triangle].neighbours[k] == other) return k;
  return -1;
}

void TriangleComplex::gather(int vertex, Star& star) const {
  star.center = vertex;
  star.ring.clear();
  star.triangles.clear();
  star.boundary = loop_[vertex] >= 0;
  int t = incident_[vertex];
  if (star.boundary) {  // clockwise to the first triangle of the fan
    for (int before = t; before >= 0; before = slots_[t].neighbours[corner_index(t, vertex)]) t = before;
  }
  const int first = t;
  do {
    const int m = corner_index(t, vertex);
    star.triangles.push_back(t);
    star.ring.push_back(slots_[t].corners[(m + 1) % 3]);
    const int next = slots_[t].neighbours[(m + 2) % 3];
    if (next < 0) star.ring.push_back(slots_[t].corners[(m + 2) % 3]);
    t = next;
  } while (t >= 0 && t != first);
}

bool TriangleComplex::edge_at(int a, int b) const {
  const int first = incident_[a];
  const bool copied = seams_.point_of(b) >= 0;
  const auto has = [&](int t) {
    return corner_index(t, b) >= 0 || (copied && std::any_of(slots_[t].corners.begin(), slots_[t].corners.end(),
                                                             [&](int v) { return seams_.same(v, b); }));
  };
  int t = first;
  do {  // counter-clockwise
    if (has(t)) return true;
    t = slots_[t].neighbours[(corner_index(t, a) + 2) % 3];
  } while (t >= 0 && t != first);
  if (t == first) return false;
  for (t = slots_[first].neighbours[corner_index(first, a)]; t >= 0; t = slots_[t].neighbours[corner_index(t, a)])
    if (has(t)) return true;
  return false;
}

bool TriangleComplex::edge_exists(int a, int b) const {
  const int point = seams_.point_of(a);
  if (point < 0) return edge_at(a, b);
  return seams_.same(a, b) || std::any_of(copies_[point].begin(), copies_[point].end(),
                                          [&](int copy) { return incident_[copy] >= 0 && edge_at(copy, b); });
}

void TriangleComplex::replace(const Star& star, const std::vector<RingTriangle>& triangles, std::vector<int>& slots) {
  assert(static_cast<int>(triangles.size()) == star.size() - 2);
  const int n = star.size();
  std::vector<int> outer(star.triangles.size());
  for (std::size_t k = 0; k < outer.size(); ++k) {
    outer[k] = opposite(star.triangles[k], star.center);
  }
  std::vector<int> outer_edge(outer.size(), -1);
  for (std::size_t k = 0; k < outer.size(); ++k)
    if (outer[k] >= 0) {
      // Two ring edges can face the same outer triangle, so the edge is found by its vertices.
      const int a = star.ring[(k + 1) % n];
      outer_edge[k] = corner_index(outer[k], a);
    }

  slots.assign(star.triangles.begin(), star.triangles.begin() + triangles.size());
  std::vector<std::array<int, 4>> open;  // diagonals seen once: from, to, slot, edge
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const int slot = slots[i];
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      slots_[slot].corners[k] = star.ring[a];
      incident_[star.ring[a]] = slot;
      if ((a + 1) % n == b && !(star.boundary && b == 0)) {
        slots_[slot].neighbours[k] = outer[a];
        if (outer[a] >= 0) slots_[outer[a]].neighbours[outer_edge[a]] = slot;
        continue;
      }
      slots_[slot].neighbours[k] = -1;
      for (auto& d : open)
        if (d[0] == b && d[1] == a) {
          slots_[slot].neighbours[k] = d[2];
          slots_[d[2]].neighbours[d[3]] = slot;
        }
      open.push_back({a, b, slot, k});
    }
  }
  for (std::size_t i = triangles.size(); i < star.triangles.size(); ++i)
    slots_[star.triangles[i]].corners = {-1, -1, -1};
  incident_[star.center] = -1;
  const int other = seams_.other_of(star.center);
  if (other < 0 || incident_[other] < 0) --component_size_[component_[star.center]];
  if (star.boundary) --loop_size_[loop_[star.center]];
}

}  // namespace gsp
