#include "param/simplify/overlay.h"

#include <algorithm>
#include <optional>

#include "mesh/error.h"
#include "param/removal/flatten.h"

namespace gsp {

namespace {

using Hold = PlanarRegion::Hold;

constexpr int kMostPieces = 10;   // for each of the surface's own vertices in a star,
constexpr int kFewVertices = 16;  // and as many for so many more: twice a usual star's on thin limbs

}  // namespace

OverlayMap::OverlayMap(std::shared_ptr<const Surface> surface, Winding winding)
    : surface_(std::move(surface)),
      winding_(winding),
      complex_(*surface_),
      refined_(std::make_unique<RefinedSurface>(surface_)),
      region_(*refined_),
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
  std::vector<int> faces;
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) {
    const int t = star_.triangles[k];
    star_index_[t] = static_cast<int>(k);
    for (int f : pieces_[t])
      if (refined_->alive(f)) faces.push_back(f);
    backup.pieces.push_back(std::move(pieces_[t]));
    pieces_[t].clear();
  }
  region_.begin(faces);
  for (int v : region_.vertices()) {
    const Place& at = place_[v];
    const bool on_ring = at.triangle < 0 && at.a != star_.center && at.b != star_.center;
    region_.place(v, flat_of(v), on_ring ? Hold::Ring : Hold::Free);
    backup.place.push_back(at);
  }
  backup.refined = refined_->snapshot(faces, region_.vertices());
  backup.star = star_;
  backup.vertices = region_.vertices();
  return backup;
}

void OverlayMap::leave() {
  region_.leave();
  for (int v : star_.ring) ring_index_[v] = -1;
}

void OverlayMap::take_back(const Backup& backup) {
  refined_->restore(backup.refined);
  place_.resize(refined_->vertex_count());
  for (std::size_t i = 0; i < backup.place.size(); ++i) place_[backup.vertices[i]] = backup.place[i];
  for (std::size_t k = 0; k < backup.star.triangles.size(); ++k) pieces_[backup.star.triangles[k]] = backup.pieces[k];
}

bool OverlayMap::cut_all(const Removal& removal) {
  // Every new edge joins the first and the last corner of exactly one triangle.
  return std::all_of(removal.triangles.begin(), removal.triangles.end(), [&](const RingTriangle& t) {
    return (t[0] == 0 && t[2] == star_.size() - 1) || region_.cut(star_.ring[t[0]], star_.ring[t[2]]);
  });
}

/// The two boundary edges at the centre have become one.
void OverlayMap::straighten_boundary() {
  const int first = star_.ring.front(), last = star_.ring.back();
  for (int v : region_.vertices())
    if (v != first && v != last && static_cast<std::size_t>(v) < place_.size() &&
        (on_side(place_[v], star_.center, first) || on_side(place_[v], star_.center, last)))
      region_.put_on(v, {first, last});
}

/// Gives the pieces inside one new triangle to it, if they are all large enough.
bool OverlayMap::fill(int slot, const RingTriangle& triangle) {
  const int corner[3] = {star_.ring[triangle[0]], star_.ring[triangle[1]], star_.ring[triangle[2]]};
  int seed = -1;
  refined_->for_each_outgoing(corner[0], [&](int h) {
    const int to = refined_->to(h);
    if (to != corner[0] && on_side(place_[to], corner[0], corner[1])) seed = h / 3;
  });
  if (seed < 0) return false;
  std::vector<int>& pieces = pieces_[slot];
  pieces.assign(1, seed);
  filled_[seed] = 1;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * pieces[i] + k, other = refined_->twin(h);
      if (other < 0 || !region_.holds_face(other / 3) || filled_[other / 3]) continue;
      const Place &p = place_[refined_->from(h)], &q = place_[refined_->to(h)];
      bool side = false;
      for (int s = 0; s < 3; ++s)
        side |= on_side(p, corner[s], corner[(s + 1) % 3]) && on_side(q, corner[s], corner[(s + 1) % 3]);
      if (side) continue;
      filled_[other / 3] = 1;
      pieces.push_back(other / 3);
    }
  const Complex plane[3] = {ring_[triangle[0]], ring_[triangle[1]], ring_[triangle[2]]};
  const double whole = chart_area(plane[0], plane[1], plane[2]);
  for (int f : pieces) {
    if (!(region_.area(f) > kLeastPiece * whole)) return false;
    for (int v : refined_->corners(f)) {
      if (region_.hold(v) != Hold::Free) continue;
      const auto w = barycentric(region_.flat(v), plane[0], plane[1], plane[2]);
      place_[v] = {slot, -1, -1, w[1], w[2]};
    }
  }
  return true;
}

/// Whether the cuts have left far more pieces than the surface has vertices there. Around a small handle edges of the
/// complex can come to wind about it, once more with every removal, until no map of use is left.
bool OverlayMap::winds() const {
  const auto own =
      std::count_if(region_.vertices().begin(), region_.vertices().end(), [&](int v) { return !refined_->added(v); });
  return static_cast<long>(region_.faces().size()) > kMostPieces * (own + kFewVertices);
}

bool OverlayMap::remove(const std::vector<Removal>& removals) {
  std::optional<TriangleComplex> before;
  if (removals.size() > 1) before = complex_;
  std::vector<Backup> backups;
  for (const Removal& removal : removals) {
    backups.push_back(lay_out(removal.vertex));
    if (cut_star(removal)) continue;
    for (; !backups.empty(); backups.pop_back()) take_back(backups.back());
    if (before) complex_ = *before;
    return false;
  }
  return true;
}

/// Makes one removal of which the pieces are laid out. False where it cannot be made, and must be taken back.
bool OverlayMap::cut_star(const Removal& removal) {
  region_.relax();
  bool possible = cut_all(removal) && (winding_ == Winding::Allowed || !winds());
  if (possible) {
    if (star_.boundary) straighten_boundary();
    region_.relax();
    place_.resize(refined_->vertex_count());
    for (int v : region_.vertices())
      if (region_.hold(v) == Hold::Edge)
        place_[v] = {-1, region_.line(v).first, region_.line(v).second, region_.share_on_line(v), 0.0};
    filled_.resize(refined_->face_slots(), 0);
    for (int f : region_.faces()) filled_[f] = 0;
    for (std::size_t t = 0; t < removal.triangles.size() && possible; ++t)
      possible = fill(star_.triangles[t], removal.triangles[t]);
  }
  if (possible) {
    complex_.replace(star_, removal.triangles, slots_);
    region_.take_out();
  }
  leave();
  return possible;
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
  throw Error(Cause::Internal, "a vertex on an edge of the complex lies in neither triangle beside it", Element::Vertex,
              v);
}

Atlas OverlayMap::atlas_on(const RefinedSurface::Compact& compact) const {
  Atlas atlas;
  const auto cut = std::make_shared<Surface>(compact.mesh);
  cut->seams = surface_->seams;
  atlas.surface = cut;
  atlas.first_added = surface_->mesh.vertex_count();
  const Surface& surface = *atlas.surface;
  const int count = surface.mesh.vertex_count();
  std::vector<Place> place(count);
  for (int v = 0; v < refined_->vertex_count(); ++v)
    if (compact.vertex[v] >= 0) place[compact.vertex[v]] = place_[v];
  atlas.corner.assign(count, -1);
  for (int v = 0; v < surface_->mesh.vertex_count(); ++v) {
    if (surface.halfedges.outgoing[v] < 0 || place[v].a != v) continue;
    atlas.corner[v] = atlas.base.vertex_count();
    atlas.base.vertices.push_back(v);
  }
  std::vector<int> chart(surface.mesh.faces.size());  // per piece
  std::vector<int> piece_chart(refined_->face_slots(), -1);
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

EditableAtlas OverlayMap::coarsened() const {
  RefinedSurface::Compact compact = refined_->compact();
  Atlas atlas = atlas_on(compact);
  return coarsen({*refined_, std::move(atlas), std::move(compact.vertex), std::move(compact.halfedge)});
}

}  // namespace gsp
