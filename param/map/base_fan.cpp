#include "param/map/base_fan.h"

#include <algorithm>

#include "mesh/halfedges.h"
#include "param/map/tolerances.h"

namespace gsp {

namespace {

using tolerance::kOnEdge;

}  // namespace

bool inside_chart(Complex z) {
  const auto w = chart_barycentric(z);
  return std::min({w[0], w[1], w[2]}) >= -kOnEdge;
}

Arrival walk_straight(const BaseComplex& base, int chart, Complex from, Complex to, std::vector<int>* sides) {
  Arrival at{chart, {}};
  int entered = -1;  // edge of the chart by which the way came in
  for (int step = 0; step <= base.face_count(); ++step) {
    const auto start = chart_barycentric(at.change.apply(from)), end = chart_barycentric(at.change.apply(to));
    // Edge k runs from corner k to k+1, opposite to corner k+2.
    int crossed = -1;
    double first = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double before = start[(k + 2) % 3], after = end[(k + 2) % 3];
      if (k == entered || after >= -kOnEdge) continue;
      const double share = before / (before - after);
      if (crossed >= 0 && share >= first) continue;
      crossed = k;
      first = share;
    }
    if (crossed < 0) return at;
    const int side = 3 * at.chart + crossed;
    if (base.twins[side] < 0) break;
    if (sides) sides->push_back(side);
    at.change = base.across(side) * at.change;
    at.chart = base.twins[side] / 3;
    entered = base.twins[side] % 3;
  }
  at.reached = false;
  return at;
}

std::optional<Arrival> follow(const BaseComplex& base, int chart, Complex from, Complex to, std::vector<int>* sides) {
  const Arrival at = walk_straight(base, chart, from, to, sides);
  return at.reached ? std::optional<Arrival>(at) : std::nullopt;
}

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

BaseFan base_fan(const BaseComplex& base, int halfedge) {
  BaseFan fan;
  int first = halfedge;
  do {  // clockwise, to the boundary if there is one
    const int twin = base.twins[first];
    fan.boundary = twin < 0;
    if (fan.boundary) break;
    first = Halfedges::next(twin);
  } while (first != halfedge);
  int h = first;
  do {
    fan.sectors.push_back({h / 3, h % 3});
    h = base.twins[Halfedges::prev(h)];
  } while (h >= 0 && h != first);
  return fan;
}

std::vector<BaseFan> base_fans(const BaseComplex& base) {
  std::vector<int> first(base.vertices.size(), -1);
  for (int h = 0; h < static_cast<int>(base.twins.size()); ++h)
    if (int& at = first[base.faces[h / 3][h % 3]]; at < 0) at = h;
  std::vector<BaseFan> fans;
  for (int h : first) fans.push_back(base_fan(base, h));
  return fans;
}

int find_base_face(const BaseComplex& base, const std::vector<BaseFan>& fans, const std::array<int, 3>& corners) {
  for (const BaseFan::Sector& s : fans[corners[0]].sectors)
    if (base.faces[s.face][(s.corner + 1) % 3] == corners[1] && base.faces[s.face][(s.corner + 2) % 3] == corners[2])
      return s.face;
  return -1;
}

int find_base_edge(const BaseComplex& base, const std::vector<BaseFan>& fans, int a, int b) {
  for (const BaseFan::Sector& s : fans[a].sectors)
    if (base.faces[s.face][(s.corner + 1) % 3] == b) return 3 * s.face + s.corner;
  return -1;
}

}  // namespace gsp
