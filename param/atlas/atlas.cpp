#include "param/atlas/atlas.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "mesh/error.h"
#include "param/map/convex_clip.h"
#include "param/map/tolerances.h"

namespace gsp {

void Atlas::change_chart(int vertex, int chart, const Transition& change) {
  assert(corner[vertex] < 0);
  patch[vertex] = chart;
  position[vertex] = change.apply(position[vertex]);
  const Transition back = change.inverse();
  surface->for_each_neighbour(vertex, [&](int, int edge, bool forward) {
    transition[edge] = forward ? change * transition[edge] : transition[edge] * back;
  });
}

bool Atlas::reassign(int vertex) {
  const Complex z = position[vertex];
  if (inside_chart(z)) return true;
  bool found = false, corners_only = true;
  surface->for_each_neighbour(vertex, [&](int w, int edge, bool forward) {
    corners_only &= corner[w] >= 0;
    if (found || corner[w] >= 0 || !inside_chart(position[w])) return;
    const Transition to_neighbour = towards(edge, forward).inverse();
    const auto arrival = follow(base, patch[w], position[w], to_neighbour.apply(z));
    if (!arrival) return;
    change_chart(vertex, arrival->chart, arrival->change * to_neighbour);
    found = true;
  });
  return corners_only ? reassign_from_ring(vertex) : found;
}

/// Transitions at patch corners hold up to turns only, so no edge leads from there. No base vertex lies inside the star
/// of a vertex, and what its whole ring sees is convex: a straight walk from one such place to the vertex passes none
/// on the wrong side. The place in the chart that the vertex comes from is in its triangle.
bool Atlas::reassign_from_ring(int vertex) {
  std::vector<Complex> seen(kChartCorners.size());
  for (int k = 0; k < 3; ++k) seen[k] = kChartCorners[k].value();
  const int first = surface->halfedges.outgoing[vertex];
  for (int h = first;;) {
    const int back = Halfedges::prev(h);
    clip_to_left(seen, along(h, false).apply(position[surface->halfedges.to(h)]),
                 along(back, true).apply(position[surface->halfedges.from(back)]));
    h = surface->halfedges.rotate_ccw(h);
    if (h == first || seen.empty()) break;
  }
  const Complex start = seen.empty() ? chart_position(1.0 / 3.0, 1.0 / 3.0) : mean(seen);
  const auto arrival = follow(base, patch[vertex], start, position[vertex]);
  if (arrival) change_chart(vertex, arrival->chart, arrival->change);
  return arrival.has_value();
}

int Atlas::reassign_all() {
  std::vector<int> outside;
  for (int v = 0; v < static_cast<int>(patch.size()); ++v)
    if (is_free(v) && !inside_chart(position[v])) outside.push_back(v);
  while (!outside.empty()) {
    const std::size_t before = outside.size();
    outside.erase(std::remove_if(outside.begin(), outside.end(), [&](int v) { return reassign(v); }), outside.end());
    if (outside.size() < before) continue;
    const auto stuck = std::find_if(outside.begin(), outside.end(), [&](int v) { return reassign_from_ring(v); });
    if (stuck == outside.end()) break;
    outside.erase(stuck);
  }
  return static_cast<int>(outside.size());
}

Atlas::FaceFrame Atlas::face_frame(int face) const {
  const Triangle& t = surface->mesh.faces[face];
  int reference = 0;
  for (int k = 2; k >= 0; --k)
    if (corner[t[k]] < 0) reference = k;
  const int out = 3 * face + reference, in = Halfedges::prev(out);
  if (corner[t[reference]] >= 0)
    return corner_frame(base, fans,
                        {{corner[t[0]], corner[t[1]], corner[t[2]]},
                         {patch[t[0]], patch[t[1]], patch[t[2]]},
                         {position[t[0]], position[t[1]], position[t[2]]},
                         along(out, false),
                         along(in, true),
                         along(3 * face + 1, false)});
  FaceFrame frame;
  frame.chart = patch[t[reference]];
  frame.to_chart[(reference + 1) % 3] = along(out, false);
  frame.to_chart[(reference + 2) % 3] = along(in, true);
  return frame;
}

namespace {

/// Turns the third corner about the first until the face's third edge closes up.
void close_up(const std::vector<BaseFan>& fans, const Atlas::CornerFace& face, Atlas::FaceFrame& frame) {
  const BaseFan &fan = fans[face.corner[0]], &fan1 = fans[face.corner[1]];
  const auto turn = [&](const BaseFan& f, int chart, int sectors) {
    const int s = f.find(chart);
    return f.develop(s).inverse() * f.develop(s + sectors);
  };
  const Complex z1 = face.first.apply(face.position[1]);
  const int turns = fan.boundary ? 1 : 6, turns1 = fan1.boundary ? 1 : 6;  // six turns are the identity
  bool closed = false;
  for (int m = 0; m < turns; ++m) {
    const Transition candidate = turn(fan, frame.chart, m * fan.valence()) * face.third;
    const Complex z2 = candidate.apply(face.position[2]);
    for (int n = 0; n < turns1; ++n) {
      const Transition other = face.first * turn(fan1, face.patch[1], n * fan1.valence()) * face.between;
      if (std::abs(other.apply(face.position[2]) - z2) > tolerance::kSamePlace) continue;
      const bool upright = chart_area(face.position[0], z1, z2) > 0.0;
      if (closed && !upright) continue;
      frame.to_chart[2] = candidate;
      closed = true;
      if (upright) return;
    }
  }
}

/// Where a face between patch corners is one of the base's, its chart is that one: the first corner's own chart could
/// be told from it only by the way about the corner, which positions do not show.
void take_base_face(const BaseComplex& base, const std::vector<BaseFan>& fans, const Atlas::CornerFace& face,
                    Atlas::FaceFrame& frame) {
  std::array<Complex, 3> z;
  for (int k = 0; k < 3; ++k) z[k] = frame.to_chart[k].apply(face.position[k]);
  for (int k = 0; k < 3; ++k)
    if (std::abs(std::abs(z[(k + 1) % 3] - z[k]) - 1.0) > tolerance::kSamePlace) return;
  const int found = find_base_face(base, fans, face.corner);
  if (found < 0) return;
  frame.chart = found;
  for (int k = 0; k < 3; ++k) {
    const BaseFan& fan = fans[face.corner[k]];
    frame.to_chart[k] = fan.develop(fan.find(found)).inverse() * fan.develop(fan.find(face.patch[k]));
  }
}

}  // namespace

Atlas::FaceFrame Atlas::corner_frame(const BaseComplex& base, const std::vector<BaseFan>& fans,
                                     const CornerFace& face) {
  FaceFrame frame{face.patch[0], {Transition{}, face.first, face.third}};
  close_up(fans, face, frame);
  take_base_face(base, fans, face, frame);
  return frame;
}

std::array<Complex, 3> Atlas::face_corners(int face, const FaceFrame& frame) const {
  const Triangle& t = surface->mesh.faces[face];
  return {frame.to_chart[0].apply(position[t[0]]), frame.to_chart[1].apply(position[t[1]]),
          frame.to_chart[2].apply(position[t[2]])};
}

int Atlas::broken_faces() const {
  int broken = 0;
  for (int f = 0; f < surface->mesh.face_count(); ++f) {
    const Triangle& t = surface->mesh.faces[f];
    if (corner[t[0]] >= 0 || corner[t[1]] >= 0 || corner[t[2]] >= 0) continue;
    Transition round;
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * f + k, edge = surface->edge_of[h];
      round = round * towards(edge, surface->edge_halfedge[edge] == h);
    }
    broken += !round.is_identity();
  }
  return broken;
}

Parameterization Atlas::finish(std::vector<std::string> provenance) const {
  Parameterization map;
  map.surface = surface->mesh;
  map.base = base;
  map.patch = patch;
  map.position = position;
  map.provenance = std::move(provenance);
  map.face_chart.resize(map.surface.faces.size());
  map.face_corners.resize(map.surface.faces.size());
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const FaceFrame frame = face_frame(f);
    map.face_chart[f] = frame.chart;
    map.face_corners[f] = face_corners(f, frame);
  }
  return map;
}

Atlas atlas_of(const Parameterization& map) {
  Atlas atlas;
  atlas.surface = std::make_shared<Surface>(map.surface);
  atlas.base = map.base;
  atlas.fans = base_fans(map.base);
  atlas.patch = map.patch;
  atlas.position = map.position;
  atlas.corner.assign(map.patch.size(), -1);
  for (int b = 0; b < map.base.vertex_count(); ++b) atlas.corner[map.base.vertices[b]] = b;
  const auto into = [&](int vertex, int chart) -> Transition {
    const int from = map.patch[vertex];
    if (from == chart) return {};
    if (atlas.corner[vertex] >= 0) {
      const BaseFan& fan = atlas.fans[atlas.corner[vertex]];
      return fan.develop(fan.find(chart)).inverse() * fan.develop(fan.find(from));
    }
    for (int h = 3 * from; h < 3 * from + 3; ++h)
      if (map.base.twins[h] >= 0 && map.base.twins[h] / 3 == chart) return map.base.across(h);
    throw Error(Cause::Internal, "a vertex lies in another patch than its faces", Element::Vertex, vertex);
  };
  const Surface& surface = *atlas.surface;
  for (int h : surface.edge_halfedge) {
    const int chart = map.face_chart[h / 3];
    atlas.transition.push_back(into(surface.halfedges.from(h), chart).inverse() * into(surface.halfedges.to(h), chart));
  }
  return atlas;
}

}  // namespace gsp
