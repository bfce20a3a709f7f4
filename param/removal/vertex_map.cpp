#include "param/removal/vertex_map.h"

#include <algorithm>

#include "mesh/error.h"
#include "param/removal/flatten.h"

namespace gsp {

namespace {

/// From a face around a corner to the corner's own chart.
Transition to_home(const Atlas& atlas, int vertex, int face) {
  if (atlas.corner[vertex] < 0) return {};
  return atlas.fans[atlas.corner[vertex]].to_first_sector(face);
}

}  // namespace

VertexMap::VertexMap(std::shared_ptr<const Surface> surface, bool classify)
    : surface_(std::move(surface)),
      classify_(classify),
      complex_(*surface_),
      locations_(surface_->mesh.positions.size()),
      points_(surface_->mesh.faces.size()),
      paths_(classify ? surface_->edge_count() : 0, classify ? complex_.slot_count() : 0) {}

void VertexMap::remove(const Removal& removal) {
  complex_.gather(removal.vertex, star_);
  flatten_star(surface_->mesh.positions, star_, ring_);
  if (classify_) paths_.begin(*surface_, star_, points_);
  moving_.assign(1, star_.center);
  moving_flat_.assign(1, 0.0);
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) {
    const int slot = star_.triangles[k];
    for (int v : points_[slot]) {
      moving_.push_back(v);
      moving_flat_.push_back(flat_in_star(complex_, star_, ring_, static_cast<int>(k), locations_[v]));
    }
    points_[slot].clear();
  }
  complex_.replace(star_, removal.triangles, slots_);
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    int best_triangle = 0;
    std::array<double, 3> best{};
    double best_smallest = -1e300;
    for (std::size_t t = 0; t < removal.triangles.size(); ++t) {
      const RingTriangle& corners = removal.triangles[t];
      const auto w = barycentric(moving_flat_[i], ring_[corners[0]], ring_[corners[1]], ring_[corners[2]]);
      const double smallest = std::min({w[0], w[1], w[2]});
      if (smallest <= best_smallest) continue;
      best_smallest = smallest;
      best_triangle = static_cast<int>(t);
      best = w;
    }
    locations_[moving_[i]] = {slots_[best_triangle], best[1], best[2]};
    points_[slots_[best_triangle]].push_back(moving_[i]);
  }
  if (classify_) paths_.finish(*surface_, complex_, star_, removal.triangles, slots_, locations_);
}

VertexMap::Numbering VertexMap::number_triangles() const {
  Numbering numbering;
  numbering.face_of.assign(complex_.slot_count(), -1);
  for (int t = 0; t < complex_.slot_count(); ++t) {
    if (!complex_.alive(t)) continue;
    numbering.face_of[t] = static_cast<int>(numbering.slot_of.size());
    numbering.slot_of.push_back(t);
  }
  return numbering;
}

Transition VertexMap::edge_transition(const Atlas& atlas, const Numbering& numbering, int edge) const {
  const int h = surface_->edge_halfedge[edge];
  const int start = surface_->halfedges.from(h), end = surface_->halfedges.to(h);
  const std::vector<int>& path = paths_.path(edge);
  int first = -1, last;
  Transition through;
  if (path.empty()) {
    if (atlas.corner[start] < 0) {
      first = atlas.patch[start];
    } else if (atlas.corner[end] < 0) {
      first = atlas.patch[end];
    } else {  // along a base edge: any face that has both corners
      for (const BaseFan::Sector& s : atlas.fans[atlas.corner[start]].sectors)
        for (int k = 0; k < 3; ++k)
          if (atlas.base.faces[s.face][k] == atlas.corner[end]) first = s.face;
      if (first < 0) throw Error(Cause::Internal, "an edge between two corners is not classified", Element::Edge, edge);
    }
    last = first;
  } else {
    first = numbering.face_of[path.front()];
    last = numbering.face_of[path.back()];
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const int k = complex_.edge_towards(path[i + 1], path[i]);
      through = through * atlas.base.across(3 * numbering.face_of[path[i + 1]] + k);
    }
  }
  return to_home(atlas, start, first) * through * to_home(atlas, end, last).inverse();
}

Atlas VertexMap::atlas() const {
  Atlas atlas;
  atlas.surface = surface_;
  const Numbering numbering = number_triangles();
  const int count = surface_->mesh.vertex_count();
  atlas.corner.assign(count, -1);
  for (int v = 0; v < count; ++v) {
    if (surface_->halfedges.outgoing[v] < 0 || locations_[v].triangle >= 0) continue;
    atlas.corner[v] = atlas.base.vertex_count();
    atlas.base.vertices.push_back(v);
  }
  for (int t : numbering.slot_of) {
    const Triangle& c = complex_.corners(t);
    atlas.base.faces.push_back({atlas.corner[c[0]], atlas.corner[c[1]], atlas.corner[c[2]]});
  }
  atlas.base.connect();
  atlas.fans = base_fans(atlas.base);
  atlas.patch.assign(count, -1);
  atlas.position.assign(count, 0.0);
  for (int v = 0; v < count; ++v) {
    if (surface_->halfedges.outgoing[v] < 0) continue;
    if (atlas.corner[v] >= 0) {
      const BaseFan::Sector& home = atlas.fans[atlas.corner[v]].sectors.front();
      atlas.patch[v] = home.face;
      atlas.position[v] = kChartCorners[home.corner].value();
    } else {
      const Location& at = locations_[v];
      atlas.patch[v] = numbering.face_of[at.triangle];
      atlas.position[v] = chart_position(1.0 - at.weight1 - at.weight2, at.weight1);
    }
  }
  atlas.transition.resize(surface_->edge_count());
  for (int e = 0; e < surface_->edge_count(); ++e) atlas.transition[e] = edge_transition(atlas, numbering, e);
  return atlas;
}

}  // namespace gsp
