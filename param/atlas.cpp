#include "param/atlas.h"

#include <algorithm>

namespace gsp {

namespace {

constexpr int kLongestWalk = 64;

double smallest_weight(Complex z) {
  const auto w = chart_barycentric(z);
  return std::min({w[0], w[1], w[2]});
}

}  // namespace

const BaseFan::Sector& BaseFan::sector(int s) const {
  const int k = valence();
  return sectors[((s % k) + k) % k];
}

int BaseFan::find(int face) const {
  for (int s = 0; s < valence(); ++s)
    if (sectors[s].face == face) return s;
  return -1;
}

Transition BaseFan::develop(int s) const {
  const int corner = sector(s).corner;
  const Transition from_sector{2 * corner, kChartCorners[corner]};
  return Transition{((s % 6) + 6) % 6, {}} * from_sector.inverse();
}

std::vector<BaseFan> base_fans(const BaseComplex& base) {
  std::vector<BaseFan> fans(base.vertices.size());
  std::vector<int> first(base.vertices.size(), -1);
  for (int h = 0; h < static_cast<int>(base.twins.size()); ++h) {
    const int v = base.faces[h / 3][h % 3];
    if (first[v] < 0 || base.twins[h] < 0) first[v] = h;
  }
  for (std::size_t v = 0; v < fans.size(); ++v) {
    fans[v].boundary = base.twins[first[v]] < 0;
    for (int h = first[v]; h >= 0;) {
      fans[v].sectors.push_back({h / 3, h % 3});
      h = base.twins[Halfedges::prev(h)];
      if (h == first[v]) break;
    }
  }
  return fans;
}

void Atlas::change_chart(int vertex, int chart, const Transition& change) {
  patch[vertex] = chart;
  position[vertex] = change.apply(position[vertex]);
  const Transition back = change.inverse();
  surface->for_each_neighbour(vertex, [&](int, int edge, bool forward) {
    transition[edge] = forward ? change * transition[edge] : transition[edge] * back;
  });
}

bool Atlas::reassign(int vertex) {
  Complex z = position[vertex];
  if (smallest_weight(z) >= 0.0) return true;
  int chart = patch[vertex], best_chart = chart;
  Transition change, best_change;
  double best = smallest_weight(z);
  for (int step = 0; step < kLongestWalk; ++step) {
    const auto w = chart_barycentric(z);
    // Edge k runs from corner k to k+1, opposite to corner k+2.
    int cross_edge = -1;
    double most = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double outside = w[(k + 2) % 3];
      if (outside < most && base.twins[3 * chart + k] >= 0) {
        most = outside;
        cross_edge = 3 * chart + k;
      }
    }
    if (cross_edge < 0) break;
    const Transition across = base.across(cross_edge);
    change = across * change;
    chart = base.twins[cross_edge] / 3;
    z = across.apply(z);
    if (smallest_weight(z) > best) {
      best = smallest_weight(z);
      best_chart = chart;
      best_change = change;
    }
    if (best >= 0.0) break;
  }
  // Rounding can leave a point on a base edge outside of both sides by 1e-17: the better side is good enough.
  if (best < -1e-9) return false;
  if (best_chart != patch[vertex] || !best_change.is_identity()) change_chart(vertex, best_chart, best_change);
  return true;
}

void Atlas::reassign_all() {
  for (int v = 0; v < static_cast<int>(patch.size()); ++v)
    if (is_free(v)) reassign(v);
}

Atlas::FaceFrame Atlas::face_frame(int face) const {
  const Triangle& t = surface->mesh.faces[face];
  int reference = 0;
  for (int k = 2; k >= 0; --k)
    if (corner[t[k]] < 0) reference = k;
  FaceFrame frame;
  frame.chart = patch[t[reference]];
  const int out = 3 * face + reference, in = Halfedges::prev(out);
  const auto along = [&](int h, bool reverse) {
    const int edge = surface->edge_of[h];
    return towards(edge, (surface->edge_halfedge[edge] == h) != reverse);
  };
  frame.to_chart[(reference + 1) % 3] = along(out, false);
  frame.to_chart[(reference + 2) % 3] = along(in, true);
  if (corner[t[reference]] < 0) return frame;
  // All three are patch corners: turn the third about the first until the third edge closes up.
  const BaseFan& fan = fans[corner[t[reference]]];
  const BaseFan& fan1 = fans[corner[t[(reference + 1) % 3]]];
  const auto turn = [&](const BaseFan& f, int chart, int sectors) {
    const int s = f.find(chart);
    return f.develop(s).inverse() * f.develop(s + sectors);
  };
  const Complex z0 = position[t[reference]], z1 = frame.to_chart[(reference + 1) % 3].apply(position[t[(reference + 1) % 3]]);
  const Transition third = frame.to_chart[(reference + 2) % 3];
  const Transition between = along(Halfedges::next(out), false);  // from the third's chart to the second's
  const int turns = fan.boundary ? 1 : 6, turns1 = fan1.boundary ? 1 : 6;  // six turns are the identity
  bool closed = false;
  for (int m = 0; m < turns; ++m) {
    const Transition candidate = turn(fan, frame.chart, m * fan.valence()) * third;
    const Complex z2 = candidate.apply(position[t[(reference + 2) % 3]]);
    for (int n = 0; n < turns1; ++n) {
      const Transition other = frame.to_chart[(reference + 1) % 3] *
                               turn(fan1, patch[t[(reference + 1) % 3]], n * fan1.valence()) * between;
      if (std::abs(other.apply(position[t[(reference + 2) % 3]]) - z2) > 1e-9) continue;
      const bool upright = chart_area(z0, z1, z2) > 0.0;
      if (closed && !upright) continue;
      frame.to_chart[(reference + 2) % 3] = candidate;
      closed = true;
      if (upright) return frame;
    }
  }
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

}  // namespace gsp
