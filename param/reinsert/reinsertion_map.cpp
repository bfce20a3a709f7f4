#include "param/reinsert/reinsertion_map.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>

#include "param/map/lattice_motion.h"
#include "param/map/tolerances.h"

namespace gsp {

namespace {
constexpr double kBaseEdge = 1e-9;  // from 1, within which a length is that of a base edge
}

double ReinsertionMap::Support::weight_of(int corner) const {
  for (int k = 0; k < 3; ++k)
    if (corners[k] == corner) return weights[k];
  return 0.0;
}

ReinsertionMap::ReinsertionMap(const RemovalRecord& removed, const EditableAtlas& map)
    : decimation(removed), base(map.atlas.base), fans(map.atlas.fans) {
  assert(map.refined.original().mesh.vertex_count() == decimation.coarse.surface->mesh.vertex_count());
  const RefinedSurface& refined = map.refined;
  const CoarseSurface& coarse = decimation.coarse;
  const int first_added = coarse.surface->mesh.vertex_count(), own = own_vertices();
  const auto number = [&](int v) { return v < first_added ? coarse.vertex[v] : own + v - first_added; };
  const LooseMap from = loosen(map);
  const std::size_t count = own + refined.vertex_count() - first_added;
  loose.patch.assign(count, -1);
  loose.corner.assign(count, -1);
  loose.position.resize(count);
  links.outgoing.assign(count, -1);
  for (int v = 0; v < refined.vertex_count(); ++v) {
    loose.patch[number(v)] = from.patch[v];
    loose.corner[number(v)] = from.corner[v];
    loose.position[number(v)] = from.position[v];
  }
  std::vector<int> place(refined.face_slots(), -1);
  int alive = 0;
  for (int f = 0; f < refined.face_slots(); ++f)
    if (refined.alive(f)) place[f] = alive++;
  const std::size_t most = std::max<std::size_t>(alive, decimation.surface->mesh.faces.size());
  links.faces.reserve(most);
  links.twin.reserve(3 * most);
  loose.transition.reserve(3 * most);
  added.resize(count - own);
  for (int f = 0; f < refined.face_slots(); ++f) {
    if (place[f] < 0) continue;
    const Triangle& t = refined.corners(f);
    const int face = refined.origin(f);
    links.faces.push_back({number(t[0]), number(t[1]), number(t[2])});
    slot.push_back(coarse.slot[face]);
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * f + k, twin = refined.twin(h);
      links.twin.push_back(twin < 0 ? -1 : 3 * place[twin / 3] + twin % 3);
      loose.transition.push_back(from.transition[h]);
      links.outgoing[number(t[k])] = 3 * place[f] + k;
      if (t[k] < first_added) continue;
      Support& at = added[t[k] - first_added];
      at.weights = refined.weights_in(t[k], face);
      for (int i = 0; i < 3; ++i) at.corners[i] = coarse.vertex[coarse.surface->mesh.faces[face][i]];
    }
  }
}

Vec3 ReinsertionMap::on_surface(int v) const {
  const auto& positions = decimation.surface->mesh.positions;
  if (!is_added(v)) return positions[v];
  const Support& at = support(v);
  return at.weights[0] * positions[at.corners[0]] + at.weights[1] * positions[at.corners[1]] +
         at.weights[2] * positions[at.corners[2]];
}

/// Whether a face's own frame has the right chart, not just the right shape: positions do not show the way about patch
/// corners.
bool ReinsertionMap::knows_chart(int face) const {
  const Triangle& t = links.faces[face];
  std::array<int, 3> c;
  for (int k = 0; k < 3; ++k) c[k] = loose.corner[t[k]];
  if (c[0] < 0 || c[1] < 0 || c[2] < 0) return true;
  for (int k = 0; k < 3; ++k) {
    const Complex there = loose.transition[3 * face + k].apply(loose.position[t[(k + 1) % 3]]);
    if (std::abs(std::abs(there - loose.position[t[k]]) - 1.0) > tolerance::kSamePlace) return false;
  }
  return find_base_face(base, fans, c) >= 0;
}

Atlas::FaceFrame ReinsertionMap::frame(int face) const {
  if (knows_chart(face)) return own_frame(face);
  // From the face outward, by the half-edges that lead back.
  std::vector<int> reached{face};
  std::unordered_map<int, int> way_back{{face, -1}};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int h = 3 * reached[i]; h < 3 * reached[i] + 3; ++h) {
      const int twin = links.twin[h];
      if (twin < 0 || !way_back.emplace(twin / 3, twin).second) continue;
      reached.push_back(twin / 3);
      if (!knows_chart(twin / 3)) continue;
      Atlas::FaceFrame at = own_frame(twin / 3);
      for (int back = twin; back >= 0;) {
        const auto next = frame_across(back, at);
        if (!next) return own_frame(face);
        at = *next;
        back = way_back.at(links.twin[back] / 3);
      }
      return at;
    }
  return own_frame(face);
}

Atlas::FaceFrame ReinsertionMap::own_frame(int face) const {
  const Triangle& t = links.faces[face];
  const Transition* along = &loose.transition[3 * face];
  int reference = -1;
  for (int k = 2; k >= 0; --k)
    if (loose.corner[t[k]] < 0 && (reference < 0 || boundary(t[k]))) reference = k;
  if (reference < 0)
    return Atlas::corner_frame(base, fans,
                               {{loose.corner[t[0]], loose.corner[t[1]], loose.corner[t[2]]},
                                {loose.patch[t[0]], loose.patch[t[1]], loose.patch[t[2]]},
                                {loose.position[t[0]], loose.position[t[1]], loose.position[t[2]]},
                                along[0],
                                along[2].inverse(),
                                along[1]});
  Atlas::FaceFrame frame;
  frame.chart = loose.patch[t[reference]];
  frame.to_chart[(reference + 1) % 3] = along[reference];
  frame.to_chart[(reference + 2) % 3] = along[(reference + 2) % 3].inverse();
  return frame;
}

std::optional<Atlas::FaceFrame> ReinsertionMap::frame_across(int h, const Atlas::FaceFrame& from) const {
  const int twin = links.twin[h];
  Atlas::FaceFrame to = own_frame(twin / 3);
  const int here[2] = {h % 3, Halfedges::next(h) % 3}, there[2] = {Halfedges::next(twin) % 3, twin % 3};
  const int end[2] = {links.from(h), links.to(h)};
  std::optional<Transition> change;
  for (int i = 0; i < 2 && !change; ++i)
    if (loose.corner[end[i]] < 0) change = from.to_chart[here[i]] * to.to_chart[there[i]].inverse();
  if (!change)  // transitions at patch corners hold up to turns only
    change = lattice_motion(
        to.to_chart[there[0]].apply(loose.position[end[0]]), to.to_chart[there[1]].apply(loose.position[end[1]]),
        from.to_chart[here[0]].apply(loose.position[end[0]]), from.to_chart[here[1]].apply(loose.position[end[1]]));
  if (!change) return std::nullopt;
  to.chart = from.chart;
  for (Transition& t : to.to_chart) t = *change * t;
  return to;
}

std::optional<Arrival> ReinsertionMap::boundary_seat(int from, int to, Complex at_from, Complex at_to) const {
  for (const BaseFan::Sector& s : fans[loose.corner[from]].sectors) {
    const int next = (s.corner + 1) % 3;
    if (base.twins[3 * s.face + s.corner] >= 0 || base.faces[s.face][next] != loose.corner[to]) continue;
    const auto change = lattice_motion(at_from, at_to, kChartCorners[s.corner].value(), kChartCorners[next].value());
    if (change) return Arrival{s.face, *change};
  }
  return std::nullopt;
}

void ReinsertionMap::change_chart(int vertex, const Arrival& arrival) {
  loose.patch[vertex] = arrival.chart;
  loose.position[vertex] = arrival.change.apply(loose.position[vertex]);
  const Transition back = arrival.change.inverse();
  links.for_each_outgoing(vertex, boundary(vertex), [&](int h) {
    loose.transition[h] = arrival.change * loose.transition[h];
    loose.transition[Halfedges::prev(h)] = loose.transition[Halfedges::prev(h)] * back;
  });
}

int ReinsertionMap::add_vertex() {
  added.emplace_back();
  links.outgoing.push_back(-1);
  loose.patch.push_back(-1);
  loose.corner.push_back(-1);
  loose.position.push_back(0.0);
  return static_cast<int>(links.outgoing.size()) - 1;
}

/// Sets the transitions of a face's half-edges at a new vertex, which lies in the chart of the frame. `into`: of the
/// face's corners, that of the new vertex the identity.
void ReinsertionMap::connect(int face, const std::array<Transition, 3>& into, int middle) {
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * face + k, next = (k + 1) % 3;
    if (links.from(h) == middle) loose.transition[h] = into[next];
    if (links.to(h) == middle) loose.transition[h] = into[k].inverse();
  }
}

bool ReinsertionMap::split(int h, double share, int middle) {
  assert(share > 0.0 && share < 1.0);
  const int twin = links.twin[h];
  std::vector<std::pair<int, Atlas::FaceFrame>> sides{{h, frame(h / 3)}};
  const Atlas::FaceFrame here = sides.front().second;
  if (twin >= 0) {
    const auto there = frame_across(h, here);
    if (!there) return false;
    sides.emplace_back(twin, *there);
  }
  const Complex a = here.to_chart[h % 3].apply(loose.position[links.from(h)]);
  const Complex b = here.to_chart[Halfedges::next(h) % 3].apply(loose.position[links.to(h)]);
  loose.patch[middle] = here.chart;
  loose.position[middle] = (1.0 - share) * a + share * b;
  int second = static_cast<int>(links.faces.size());
  links.split(h, middle);
  loose.transition.resize(links.twin.size());
  for (const auto& [side, into] : sides) {
    const int first = side / 3, start = side % 3, end = (start + 1) % 3, apex = (start + 2) % 3;
    const auto& t = into.to_chart;
    slot.push_back(slot[first]);
    loose.transition[3 * second + 1] = loose.transition[3 * first + end];  // from the edge's end to the apex
    std::array<Transition, 3> kept = t;
    kept[end] = {};
    connect(first, kept, middle);
    connect(second, {Transition{}, t[end], t[apex]}, middle);
    ++second;
  }
  return true;
}

void ReinsertionMap::insert(int face, const std::array<double, 3>& weights, int middle) {
  const Atlas::FaceFrame here = frame(face);
  const Triangle t = links.faces[face];
  loose.patch[middle] = here.chart;
  loose.position[middle] = 0.0;
  for (int k = 0; k < 3; ++k) loose.position[middle] += weights[k] * here.to_chart[k].apply(loose.position[t[k]]);
  links.insert(face, middle);
  loose.transition.resize(links.twin.size());
  const int second = static_cast<int>(links.faces.size()) - 2;
  slot.resize(links.faces.size(), slot[face]);
  loose.transition[3 * second] = loose.transition[3 * face + 1];
  loose.transition[3 * second + 3] = loose.transition[3 * face + 2];
  const auto& into = here.to_chart;
  connect(face, {into[0], into[1], Transition{}}, middle);
  connect(second, {into[1], into[2], Transition{}}, middle);
  connect(second + 1, {into[2], into[0], Transition{}}, middle);
}

Atlas ReinsertionMap::part(const std::vector<int>& faces, std::vector<int>& vertices) const {
  vertices = links.vertices_of(faces);
  const auto number = [&](int v) {
    return static_cast<int>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  Mesh mesh;
  Atlas atlas;
  for (int v : vertices) {
    mesh.positions.push_back(on_surface(v));
    atlas.corner.push_back(loose.corner[v]);
    atlas.patch.push_back(loose.patch[v]);
    atlas.position.push_back(loose.position[v]);
  }
  for (int f : faces) {
    const Triangle& t = links.faces[f];
    mesh.faces.push_back({number(t[0]), number(t[1]), number(t[2])});
  }
  atlas.surface = std::make_shared<const Surface>(std::move(mesh));
  atlas.base = base;
  atlas.fans = fans;
  for (int h : atlas.surface->edge_halfedge) atlas.transition.push_back(loose.transition[3 * faces[h / 3] + h % 3]);
  return atlas;
}

EditableAtlas ReinsertionMap::finish() && {
  const Surface& fine = *decimation.surface;
  const int own = own_vertices();
  // Added vertices that are out leave their numbers to those that follow.
  std::vector<int> number(links.outgoing.size(), -1);
  std::vector<RefinedSurface::Point> points;
  for (int v = 0; v < static_cast<int>(number.size()); ++v) {
    if (!is_added(v)) number[v] = v;
    if (!is_added(v) || links.outgoing[v] < 0) continue;
    RefinedSurface::Point point{slot[links.outgoing[v] / 3], {}};
    for (int k = 0; k < 3; ++k) point.weights[k] = support(v).weight_of(fine.mesh.faces[point.face][k]);
    number[v] = own + static_cast<int>(points.size());
    points.push_back(point);
  }
  TriangleLinks joined;
  LooseMap whole;
  std::vector<int> place(links.faces.size(), -1), turn(links.faces.size(), 0), origin;
  for (int f = 0; f < static_cast<int>(links.faces.size()); ++f) {
    if (!links.alive(f)) continue;
    Triangle t;
    for (int k = 0; k < 3; ++k) t[k] = number[links.faces[f][k]];
    while (turn[f] < 2 && t[turn[f]] != fine.mesh.faces[slot[f]][0]) ++turn[f];  // a whole face keeps its first corner
    place[f] = static_cast<int>(joined.faces.size());
    joined.faces.push_back({t[turn[f]], t[(turn[f] + 1) % 3], t[(turn[f] + 2) % 3]});
    origin.push_back(slot[f]);
  }
  const auto moved = [&](int h) { return h < 0 ? -1 : 3 * place[h / 3] + (h % 3 + 3 - turn[h / 3]) % 3; };
  joined.twin.resize(3 * joined.faces.size());
  whole.transition.resize(joined.twin.size());
  for (int h = 0; h < static_cast<int>(links.twin.size()); ++h) {
    if (place[h / 3] < 0) continue;
    joined.twin[moved(h)] = moved(links.twin[h]);
    whole.transition[moved(h)] = loose.transition[h];
  }
  const std::size_t count = own + points.size();
  joined.outgoing.resize(count);
  whole.patch.resize(count);
  whole.corner.resize(count);
  whole.position.resize(count);
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    joined.outgoing[number[v]] = moved(links.outgoing[v]);
    whole.patch[number[v]] = loose.patch[v];
    whole.corner[number[v]] = loose.corner[v];
    whole.position[number[v]] = loose.position[v];
  }
  return tighten(RefinedSurface(decimation.surface, std::move(joined), std::move(origin), points), whole, base, fans);
}

}  // namespace gsp
