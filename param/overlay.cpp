#include "param/overlay.h"

#include <algorithm>

#include "mesh/error.h"
#include "param/flatten.h"
#include "param/omega.h"

namespace gsp {

namespace {

constexpr double kSnap = 0.2;           // of a crossed edge, within which its end is moved onto the cut instead
constexpr double kSmall = 1e-8;         // area of a piece in the plane, the ring's radius being 1, below which it is made larger
constexpr double kLeast = 1e-13;        // share of a triangle, below which rounding could fold a piece
constexpr int kRelaxations = 3;
constexpr double kGain = 1.01;
constexpr int kLongestCut = 1 << 20;

}  // namespace

OverlayMap::OverlayMap(std::shared_ptr<const Surface> surface)
    : surface_(std::move(surface)),
      complex_(*surface_),
      refined_(surface_),
      place_(surface_->mesh.positions.size()),
      pieces_(surface_->mesh.faces.size()),
      ring_index_(surface_->mesh.positions.size(), -1),
      star_index_(surface_->mesh.faces.size(), -1) {
  for (std::size_t v = 0; v < place_.size(); ++v) place_[v].a = static_cast<int>(v);
  for (std::size_t f = 0; f < pieces_.size(); ++f) pieces_[f].assign(1, static_cast<int>(f));
}

bool OverlayMap::on_side(const Place& at, int a, int b) {
  if (at.triangle >= 0) return false;
  if (at.b < 0) return at.a == a || at.a == b;
  return (at.a == a && at.b == b) || (at.a == b && at.b == a);
}

Complex OverlayMap::flat_of(int v) const {
  const auto corner = [&](int c) { return c == star_.center ? Complex(0.0) : ring_[ring_index_[c]]; };
  const Place& at = place_[v];
  if (at.triangle >= 0)
    return flat_in_star(complex_, star_, ring_, star_index_[at.triangle], {at.triangle, at.weight1, at.weight2});
  if (at.b < 0) return corner(at.a);
  return (1.0 - at.weight1) * corner(at.a) + at.weight1 * corner(at.b);
}

/// Lays the pieces of the star into the plane. Returns what `take_back` needs.
OverlayMap::Backup OverlayMap::lay_out(int vertex) {
  Backup backup;
  complex_.gather(vertex, star_);
  flatten_star(surface_->mesh.positions, star_, ring_);
  for (int k = 0; k < star_.size(); ++k) ring_index_[star_.ring[k]] = k;
  region_.clear();
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) {
    const int t = star_.triangles[k];
    star_index_[t] = static_cast<int>(k);
    for (int f : pieces_[t])
      if (refined_.alive(f)) region_.push_back(f);
    backup.pieces.push_back(std::move(pieces_[t]));
    pieces_[t].clear();
  }
  piece_state_.resize(refined_.face_slots(), PieceState::Outside);
  for (int f : region_) piece_state_[f] = PieceState::Open;
  const std::size_t count = refined_.vertex_count();
  flat_.resize(count);
  in_region_.resize(count, 0);
  hold_.resize(count, Hold::Free);
  region_vertices_.clear();
  for (int f : region_)
    for (int v : refined_.corners(f)) {
      if (in_region_[v]) continue;
      in_region_[v] = 1;
      region_vertices_.push_back(v);
      flat_[v] = flat_of(v);
      const Place& at = place_[v];
      const bool on_ring = at.triangle < 0 && at.a != star_.center && at.b != star_.center;
      hold_[v] = on_ring ? Hold::Ring : Hold::Free;
      backup.place.push_back(at);
    }
  backup.refined = refined_.snapshot(region_, region_vertices_);
  return backup;
}

void OverlayMap::leave() {
  for (int f : region_) piece_state_[f] = PieceState::Outside;
  for (int v : region_vertices_) in_region_[v] = 0;
  for (int v : star_.ring) ring_index_[v] = -1;
}

void OverlayMap::take_back(const Backup& backup) {
  leave();
  refined_.restore(backup.refined);
  place_.resize(refined_.vertex_count());
  flat_.resize(place_.size());
  in_region_.resize(place_.size());
  hold_.resize(place_.size());
  piece_state_.resize(refined_.face_slots());
  for (std::size_t i = 0; i < backup.place.size(); ++i) place_[region_vertices_[i]] = backup.place[i];
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) pieces_[star_.triangles[k]] = backup.pieces[k];
}

/// Moves a vertex to where a cut meets one of its edges, at a share of its length, if that spoils no piece: the nearer, the
/// worse would be the slivers beside the vertex where it was.
bool OverlayMap::move_onto_cut(int v, Complex to, double share) {
  if (share > kSnap) return false;
  if (hold_[v] != Hold::Free || (!refined_.added(v) && surface_->halfedges.boundary_vertex(v))) return false;
  bool possible = true;
  refined_.for_each_outgoing(v, [&](int h) {
    const Complex x = flat_[refined_.to(h)], y = flat_[refined_.from(Halfedges::prev(h))];
    possible &= thickness(to, x, y) > std::min(kThin, kWorse * share / kSnap * thickness(flat_[v], x, y));
  });
  if (possible) flat_[v] = to;
  return possible;
}

/// The vertex after `at` on the cut toward ring vertex j, which is added, or moved there, where there is none; -1 where the
/// pieces in its way have no area to cut.
int OverlayMap::next_on_cut(int at, int j) {
  const int target = star_.ring[j];
  const Complex direction = flat_[target] - flat_[at];
  int crossed = -1, found = -1;
  double share = 0.0;
  refined_.for_each_outgoing(at, [&](int h) {
    if (piece_state_[h / 3] != PieceState::Open) return;
    const int p = refined_.to(h), q = refined_.from(Halfedges::prev(h));
    if (p == target || q == target) found = target;
    if (found >= 0 || crossed >= 0) return;
    const double right = cross(direction, flat_[p] - flat_[at]), left = cross(direction, flat_[q] - flat_[at]);
    const int next = Halfedges::next(h);
    if (right > 0.0 || left <= 0.0) return;
    crossed = next;
    share = right / (right - left);
  });
  if (found >= 0) return found;
  if (crossed < 0 || refined_.twin(crossed) < 0 || piece_state_[refined_.twin(crossed) / 3] != PieceState::Open)
    return -1;
  const int p = refined_.from(crossed), q = refined_.to(crossed);
  const Complex at_cut = (1.0 - share) * flat_[p] + share * flat_[q];
  if (move_onto_cut(p, at_cut, share)) return p;
  if (move_onto_cut(q, at_cut, 1.0 - share)) return q;
  if (!(share > 0.0 && share < 1.0)) return -1;
  const int before = refined_.face_slots();
  const int added = refined_.split(crossed, share);
  for (int f = before; f < refined_.face_slots(); ++f) {
    region_.push_back(f);
    piece_state_.push_back(PieceState::Open);
  }
  place_.emplace_back();
  flat_.push_back(at_cut);
  in_region_.push_back(1);
  hold_.push_back(Hold::Free);
  region_vertices_.push_back(added);
  return added;
}

/// Cuts the pieces along the new edge between ring vertices i and j, if they can be.
bool OverlayMap::cut(int i, int j) {
  const int start = star_.ring[i], end = star_.ring[j];
  int at = start;
  for (int step = 0; step < kLongestCut; ++step) {
    at = next_on_cut(at, j);
    if (at == end) return true;
    if (at < 0) return false;
    place_[at] = {-1, start, end, 0.0, 0.0};
    hold_[at] = Hold::Edge;
  }
  return false;
}

bool OverlayMap::cut_all(const Removal& removal) {
  // Every new edge joins the first and the last corner of exactly one triangle.
  return std::all_of(removal.triangles.begin(), removal.triangles.end(), [&](const RingTriangle& t) {
    return (t[0] == 0 && t[2] == star_.size() - 1) || cut(t[0], t[2]);
  });
}

/// The two boundary edges at the centre have become one.
void OverlayMap::straighten_boundary() {
  const int first = star_.ring.front(), last = star_.ring.back();
  for (int v : region_vertices_)
    if (v == star_.center || on_side(place_[v], star_.center, first) || on_side(place_[v], star_.center, last)) {
      if (v == first || v == last) continue;
      place_[v] = {-1, first, last, 0.0, 0.0};
      hold_[v] = Hold::Edge;
    }
}

/// How far along the new edge on which v lies a place is, 0 to 1 from its `a` to its `b`.
double OverlayMap::share_on_edge(int v, Complex at) const {
  const Complex a = ring_[ring_index_[place_[v].a]], b = ring_[ring_index_[place_[v].b]];
  return std::real((at - a) / (b - a));
}

/// Gives the pieces inside one new triangle to it, if they are all large enough.
bool OverlayMap::fill(int slot, const RingTriangle& triangle) {
  const int corner[3] = {star_.ring[triangle[0]], star_.ring[triangle[1]], star_.ring[triangle[2]]};
  int seed = -1;
  refined_.for_each_outgoing(corner[0], [&](int h) {
    const int to = refined_.to(h);
    if (to != corner[0] && on_side(place_[to], corner[0], corner[1])) seed = h / 3;
  });
  if (seed < 0) return false;
  std::vector<int>& pieces = pieces_[slot];
  pieces.assign(1, seed);
  piece_state_[seed] = PieceState::Filled;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * pieces[i] + k, p = refined_.from(h), q = refined_.to(h);
      bool side = false;
      for (int s = 0; s < 3; ++s)
        side |= on_side(place_[p], corner[s], corner[(s + 1) % 3]) && on_side(place_[q], corner[s], corner[(s + 1) % 3]);
      const int other = refined_.twin(h);
      if (side || other < 0 || piece_state_[other / 3] != PieceState::Open) continue;
      piece_state_[other / 3] = PieceState::Filled;
      pieces.push_back(other / 3);
    }
  const double whole = chart_area(ring_[triangle[0]], ring_[triangle[1]], ring_[triangle[2]]);
  for (int f : pieces) {
    const Triangle& t = refined_.corners(f);
    if (!(chart_area(flat_[t[0]], flat_[t[1]], flat_[t[2]]) > kLeast * whole)) return false;
    for (int v : t) {
      if (hold_[v] == Hold::Ring) continue;
      if (hold_[v] == Hold::Edge) {
        place_[v].weight1 = share_on_edge(v, flat_[v]);
        continue;
      }
      const auto w = barycentric(flat_[v], ring_[triangle[0]], ring_[triangle[1]], ring_[triangle[2]]);
      place_[v] = {slot, -1, -1, w[1], w[2]};
    }
  }
  return true;
}

/// Takes added vertices that lie on no edge of the complex any more out again.
void OverlayMap::take_out() {
  for (int v : region_vertices_) {
    if (!refined_.added(v) || hold_[v] != Hold::Free) continue;
    const auto link = [&](int out) {
      return std::pair(flat_[refined_.to(out)], flat_[refined_.from(Halfedges::prev(out))]);
    };
    const int along = refined_.collapsible(v, flat_[v], link);
    if (along >= 0) refined_.collapse(along);
  }
}

double OverlayMap::quality(Complex a, Complex b, Complex c) {
  const double thick = thickness(a, b, c);
  return thick > 0.0 ? std::min(1.0, chart_area(a, b, c) / kSmall) * std::min(1.0, thick / kThin) : thick;
}

/// The least quality of the pieces around v, were it at a place.
double OverlayMap::least_quality(int v, Complex at) const {
  double least = 1.0;
  refined_.for_each_outgoing(v, [&](int h) {
    least = std::min(least, quality(at, flat_[refined_.to(h)], flat_[refined_.from(Halfedges::prev(h))]));
  });
  return least;
}

/// Moves vertices of pieces that are too thin, or too small for rounding, toward the middle of their neighbours. Otherwise
/// pieces get worse from removal to removal, and thin ones are cut most often.
void OverlayMap::relax() {
  std::vector<int> moving;
  for (int f : region_) {
    const Triangle& t = refined_.corners(f);
    if (quality(flat_[t[0]], flat_[t[1]], flat_[t[2]]) >= 1.0) continue;
    for (int v : t)
      if (hold_[v] != Hold::Ring) moving.push_back(v);
  }
  std::sort(moving.begin(), moving.end());
  moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
  for (int pass = 0; pass < kRelaxations; ++pass) {
    const auto left = std::remove_if(moving.begin(), moving.end(), [&](int v) { return !relax(v); });
    moving.erase(left, moving.end());
  }
}

bool OverlayMap::relax(int v) {
  if (hold_[v] == Hold::Free && !refined_.added(v) && surface_->halfedges.boundary_vertex(v)) return false;
  Complex middle = 0.0;
  int neighbours = 0;
  refined_.for_each_outgoing(v, [&](int h) {
    middle += flat_[refined_.to(h)];
    ++neighbours;
  });
  middle /= neighbours;
  if (hold_[v] == Hold::Edge) {  // along its edge only
    const Complex a = ring_[ring_index_[place_[v].a]], b = ring_[ring_index_[place_[v].b]];
    middle = a + share_on_edge(v, middle) * (b - a);
  }
  const double before = least_quality(v, flat_[v]);
  for (double step = 1.0; step > 0.1; step *= 0.5) {
    const Complex at = flat_[v] + step * (middle - flat_[v]);
    if (least_quality(v, at) <= std::max(0.0, kGain * before)) continue;
    flat_[v] = at;
    return true;
  }
  return false;
}

bool OverlayMap::remove(const Removal& removal) {
  const Backup backup = lay_out(removal.vertex);
  relax();
  bool possible = cut_all(removal);
  if (possible) {
    if (star_.boundary) straighten_boundary();
    relax();
    for (std::size_t t = 0; t < removal.triangles.size() && possible; ++t)
      possible = fill(star_.triangles[t], removal.triangles[t]);
  }
  if (!possible) {
    take_back(backup);
    return false;
  }
  complex_.replace(star_, removal.triangles, slots_);
  take_out();
  leave();
  return true;
}

/// Where a vertex lies in its home chart.
Complex OverlayMap::home_position(const Atlas& atlas, int v, const Place& at) {
  const Triangle& face = atlas.base.faces[atlas.patch[v]];
  if (at.triangle >= 0) return chart_position(1.0 - at.weight1 - at.weight2, at.weight1);
  Complex z = 0.0;
  for (int k = 0; k < 3; ++k) {
    const int b = atlas.base.vertices[face[k]];
    if (b == at.a) z += (1.0 - (at.b < 0 ? 0.0 : at.weight1)) * kChartCorners[k].value();
    if (b == at.b) z += at.weight1 * kChartCorners[k].value();
  }
  return z;
}

/// From a chart to the home chart of a vertex of that chart.
Transition OverlayMap::to_home(const Atlas& atlas, int v, int chart, const Place& at) {
  if (atlas.corner[v] >= 0) return atlas.fans[atlas.corner[v]].to_first_sector(chart);
  if (atlas.patch[v] == chart) return {};
  for (int k = 0; k < 3; ++k)
    if (atlas.base.twins[3 * chart + k] >= 0 && atlas.base.twins[3 * chart + k] / 3 == atlas.patch[v] &&
        on_side(at, atlas.base.vertices[atlas.base.faces[chart][k]],
                atlas.base.vertices[atlas.base.faces[chart][(k + 1) % 3]]))
      return atlas.base.across(3 * chart + k);
  throw Error(Cause::Internal, "a vertex on an edge of the complex lies in neither triangle beside it", Element::Vertex, v);
}

Atlas OverlayMap::atlas_on(const RefinedSurface::Compact& compact) const {
  Atlas atlas;
  atlas.surface = std::make_shared<const Surface>(compact.mesh);
  const Surface& surface = *atlas.surface;
  const int count = surface.mesh.vertex_count();
  std::vector<Place> place(count);
  for (int v = 0; v < refined_.vertex_count(); ++v)
    if (compact.vertex[v] >= 0) place[compact.vertex[v]] = place_[v];
  atlas.corner.assign(count, -1);
  for (int v = 0; v < surface_->mesh.vertex_count(); ++v) {
    if (surface.halfedges.outgoing[v] < 0 || place[v].a != v) continue;
    atlas.corner[v] = atlas.base.vertex_count();
    atlas.base.vertices.push_back(v);
  }
  std::vector<int> chart(surface.mesh.faces.size());  // per piece
  std::vector<int> piece_chart(refined_.face_slots(), -1);
  for (int t = 0; t < complex_.slot_count(); ++t) {
    if (!complex_.alive(t)) continue;
    const Triangle& c = complex_.corners(t);
    for (int f : pieces_[t]) piece_chart[f] = atlas.base.face_count();
    atlas.base.faces.push_back({atlas.corner[c[0]], atlas.corner[c[1]], atlas.corner[c[2]]});
  }
  atlas.base.connect();
  atlas.fans = base_fans(atlas.base);
  atlas.patch.assign(count, -1);
  atlas.position.assign(count, 0.0);
  for (std::size_t f = 0; f < chart.size(); ++f) {
    chart[f] = piece_chart[compact.halfedge[3 * f] / 3];
    for (int v : surface.mesh.faces[f]) {
      if (atlas.patch[v] >= 0) continue;
      atlas.patch[v] = atlas.corner[v] >= 0 ? atlas.fans[atlas.corner[v]].sectors.front().face : chart[f];
      atlas.position[v] = home_position(atlas, v, place[v]);
    }
  }
  atlas.transition.resize(surface.edge_count());
  for (int e = 0; e < surface.edge_count(); ++e) {
    const int h = surface.edge_halfedge[e], f = chart[h / 3];
    const int from = surface.halfedges.from(h), to = surface.halfedges.to(h);
    atlas.transition[e] = to_home(atlas, from, f, place[from]) * to_home(atlas, to, f, place[to]).inverse();
  }
  return atlas;
}

RefinedMap OverlayMap::coarsened() && {
  RefinedSurface::Compact compact = refined_.compact();
  Atlas atlas = atlas_on(compact);
  return coarsen({std::move(refined_), std::move(atlas), std::move(compact.vertex), std::move(compact.halfedge)});
}

}  // namespace gsp
