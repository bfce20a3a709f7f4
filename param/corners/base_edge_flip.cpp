#include "param/corners/base_edge_flip.h"

#include <algorithm>

#include "param/map/tolerances.h"

namespace gsp {

namespace {

constexpr int kFewestPatches = 3;  // around an interior base vertex

/// The face to the left of the base edge from p to q, else that to its right, -1 where they are not joined.
int face_beside(const BaseComplex& base, const std::vector<BaseFan>& fans, int p, int q) {
  const int there = find_base_edge(base, fans, p, q), side = there >= 0 ? there : find_base_edge(base, fans, q, p);
  return side >= 0 ? side / 3 : -1;
}

/// Nothing where the way does not lead to the end's chart as the edge's transition says, or joins two patch corners
/// other than along a base edge.
std::optional<Way> find_way(const Atlas& atlas, int edge) {
  const int h = atlas.surface->edge_halfedge[edge];
  Way way{edge, atlas.surface->halfedges.from(h), atlas.surface->halfedges.to(h), true, {}};
  if (atlas.corner[way.start] >= 0) {
    std::swap(way.start, way.end);
    way.forward = false;
  }
  if (atlas.corner[way.start] >= 0) {
    const Complex end = atlas.towards(edge, way.forward).apply(atlas.position[way.end]);
    const bool along = std::norm(end - atlas.position[way.start]) < 1.0 + tolerance::kSamePlace &&
                       face_beside(atlas.base, atlas.fans, atlas.corner[way.start], atlas.corner[way.end]) >= 0;
    return along ? std::optional(way) : std::nullopt;
  }
  if (!inside_chart(atlas.position[way.start])) return std::nullopt;
  const Transition back = atlas.towards(edge, way.forward);  // from the end's chart
  auto arrival = follow(atlas.base, atlas.patch[way.start], atlas.position[way.start],
                        back.apply(atlas.position[way.end]), &way.sides);
  if (!arrival) return std::nullopt;
  const int corner = atlas.corner[way.end];
  if (corner >= 0) {
    if (atlas.fans[corner].find(arrival->chart) < 0) return std::nullopt;
    return way;
  }
  // An end on a base edge may lie in the chart behind it.
  for (int side = 3 * arrival->chart, k = 0; arrival->chart != atlas.patch[way.end] && k < 3; ++k, ++side)
    if (atlas.base.twins[side] >= 0 && atlas.base.twins[side] / 3 == atlas.patch[way.end]) {
      way.sides.push_back(side);
      *arrival = {atlas.patch[way.end], atlas.base.across(side) * arrival->change};
    }
  if (arrival->chart != atlas.patch[way.end] || !(arrival->change == back.inverse())) return std::nullopt;
  return way;
}

bool in_patches(const FlipSite& site, int face) { return face == site.faces[0] || face == site.faces[1]; }

bool is_changed(const Atlas& atlas, const FlipSite& site, const Way& way) {
  const int corner = atlas.corner[way.end], start = atlas.corner[way.start];
  const auto at_site = [&](int c) { return c >= 0 && std::count(site.corners.begin(), site.corners.end(), c) > 0; };
  if (at_site(start) || at_site(corner)) return true;
  if (start >= 0) return false;
  return in_patches(site, atlas.patch[way.start]) || (corner < 0 && in_patches(site, atlas.patch[way.end])) ||
         std::any_of(way.sides.begin(), way.sides.end(), [&](int side) { return in_patches(site, side / 3); });
}

class Flip {
 public:
  Flip(Atlas& atlas, const FlipSite& site) : atlas_(atlas), site_(site) {
    const int h = site.diagonal, twin = atlas.base.twins[h];
    old_ = {Halfedges::prev(h), Halfedges::next(twin), Halfedges::prev(twin), Halfedges::next(h)};
    const auto [f0, f1] = site.faces;
    new_ = {3 * f0, 3 * f0 + 1, 3 * f1, 3 * f1 + 1};
  }

  bool run(const std::vector<int>& vertices, const std::vector<Way>& ways) {
    for (int v : vertices) move_vertex(v);
    change_base();
    for (int corner : site_.corners) seat(corner);
    return std::all_of(ways.begin(), ways.end(), [&](const Way& way) { return connect(way); });
  }

 private:
  bool in_rhombus(int face) const { return in_patches(site_, face); }

  /// Since A + B = C + D in the rhombus, a point of either old triangle has weights in one of the new ones.
  void move_vertex(int v) {
    const auto [a, b, c, d] = site_.corners;
    const int face = atlas_.patch[v];
    const auto w = chart_barycentric(atlas_.position[v]);
    double of_a = 0.0, of_b = 0.0, of_third = 0.0;
    for (int k = 0; k < 3; ++k) {
      const int corner = atlas_.base.faces[face][k];
      (corner == a ? of_a : corner == b ? of_b : of_third) = w[k];
    }
    const bool first = face == site_.faces[0], to_first = of_a >= of_b;
    const double shared = std::min(of_a, of_b), kept = std::max(of_a, of_b) - shared;
    const double of_c = shared + (first ? of_third : 0.0), of_d = shared + (first ? 0.0 : of_third);
    atlas_.patch[v] = site_.faces[to_first ? 0 : 1];
    atlas_.position[v] = to_first ? chart_position(of_c, kept) : chart_position(of_d, kept);
  }

  void change_base() {
    BaseComplex& base = atlas_.base;
    const auto [a, b, c, d] = site_.corners;
    const auto [f0, f1] = site_.faces;
    std::array<int, 4> outer;
    for (int i = 0; i < 4; ++i) outer[i] = base.twins[old_[i]];
    base.faces[f0] = {c, a, d};
    base.faces[f1] = {d, b, c};
    const auto join = [&](int h, int twin) {
      base.twins[h] = twin;
      if (twin >= 0) base.twins[twin] = h;
    };
    for (int i = 0; i < 4; ++i) join(new_[i], outer[i]);
    join(3 * f0 + 2, 3 * f1 + 2);
    for (int corner : site_.corners) atlas_.fans[corner] = base_fan(base, new_side_at(corner));
  }

  /// A half-edge of the new faces that leaves a corner.
  int new_side_at(int corner) const {
    const auto [f0, f1] = site_.faces;
    const auto [a, b, c, d] = site_.corners;
    return corner == a ? 3 * f0 + 1 : corner == b ? 3 * f1 + 1 : corner == c ? 3 * f0 : 3 * f1;
  }

  void seat(int corner) {
    const int v = atlas_.base.vertices[corner];
    const BaseFan::Sector& home = atlas_.fans[corner].sectors.front();
    atlas_.patch[v] = home.face;
    atlas_.position[v] = kChartCorners[home.corner].value();
  }

  /// Gives an edge the transition along its old way, the diagonal crossed where the new faces ask for it.
  bool connect(const Way& way) {
    if (atlas_.corner[way.start] >= 0) return connect_corners(way);
    const BaseComplex& base = atlas_.base;
    int at = atlas_.patch[way.start];
    Transition change;
    const auto cross = [&](int h) {
      change = base.across(h) * change;
      at = base.twins[h] / 3;
    };
    const int diagonal = site_.diagonal, diagonal_twin = old_diagonal_twin();
    for (int side : way.sides) {
      if (side == diagonal || side == diagonal_twin) continue;
      const auto place = std::find(old_.begin(), old_.end(), side);
      if (place != old_.end()) side = new_[place - old_.begin()];
      if (side / 3 != at && in_rhombus(at)) cross(3 * at + 2);
      if (side / 3 != at) return false;
      cross(side);
    }
    const int corner = atlas_.corner[way.end];
    const auto arrived = [&] { return corner < 0 ? at == atlas_.patch[way.end] : atlas_.fans[corner].find(at) >= 0; };
    if (!arrived() && in_rhombus(at)) cross(3 * at + 2);
    if (!arrived()) return false;
    if (corner >= 0) change = about_corner(way.end, at) * change;
    atlas_.transition[way.edge] = way.forward ? change.inverse() : change;
    return true;
  }

  /// From the chart of a face at a patch corner to the corner's own.
  Transition about_corner(int v, int face) const {
    const BaseFan& fan = atlas_.fans[atlas_.corner[v]];
    return fan.develop(fan.find(atlas_.patch[v])).inverse() * fan.develop(fan.find(face));
  }

  /// Gives an edge along a base edge its transition; false where that is the one that was flipped.
  bool connect_corners(const Way& way) {
    const int face = face_beside(atlas_.base, atlas_.fans, atlas_.corner[way.start], atlas_.corner[way.end]);
    if (face < 0) return false;
    const Transition change = about_corner(way.end, face) * about_corner(way.start, face).inverse();
    atlas_.transition[way.edge] = way.forward ? change.inverse() : change;
    return true;
  }

  int old_diagonal_twin() const { return Halfedges::prev(old_[1]); }

  Atlas& atlas_;
  const FlipSite& site_;
  std::array<int, 4> old_, new_;  ///< the rhombus's sides c-a, a-d, d-b, b-c
};

/// Whether a base edge joins two vertices, or where the surface was cut open, other copies of them.
bool joined(const Atlas& atlas, int c, int d) {
  const Seams& seams = atlas.surface->seams;
  if (!seams.any()) return face_beside(atlas.base, atlas.fans, c, d) >= 0;
  const auto has = [&](const Triangle& t, int b) {
    return std::any_of(t.begin(), t.end(),
                       [&](int v) { return seams.same(atlas.base.vertices[v], atlas.base.vertices[b]); });
  };
  const auto& faces = atlas.base.faces;
  return seams.same(atlas.base.vertices[c], atlas.base.vertices[d]) ||
         std::any_of(faces.begin(), faces.end(), [&](const Triangle& t) { return has(t, c) && has(t, d); });
}

}  // namespace

std::optional<FlipSite> flip_site(const Atlas& atlas, int diagonal) {
  const BaseComplex& base = atlas.base;
  const int twin = base.twins[diagonal];
  if (twin < 0) return std::nullopt;
  const auto corner = [&](int h) { return base.faces[h / 3][h % 3]; };
  const int a = corner(diagonal), b = corner(twin), c = corner(Halfedges::prev(diagonal)),
            d = corner(Halfedges::prev(twin));
  const auto too_few = [&](int v) { return atlas.fans[v].valence() <= (atlas.fans[v].boundary ? 1 : kFewestPatches); };
  if (c == d || too_few(a) || too_few(b)) return std::nullopt;
  if (!atlas.surface->seams.any() && atlas.fans[c].boundary && atlas.fans[d].boundary) return std::nullopt;
  if (joined(atlas, c, d)) return std::nullopt;
  return FlipSite{diagonal, {a, b, c, d}, {diagonal / 3, twin / 3}};
}

std::vector<int> faces_around(const Atlas& atlas, const FlipSite& site) {
  std::vector<int> faces;
  for (int corner : site.corners)
    for (const BaseFan::Sector& s : atlas.fans[corner].sectors) faces.push_back(s.face);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::optional<std::vector<Way>> changed_ways(const Atlas& atlas, const FlipSite& site, const std::vector<int>& edges) {
  std::vector<Way> ways;
  for (int edge : edges) {
    std::optional<Way> way = find_way(atlas, edge);
    if (!way) return std::nullopt;
    if (is_changed(atlas, site, *way)) ways.push_back(std::move(*way));
  }
  return ways;
}

bool flip(Atlas& atlas, const FlipSite& site, const std::vector<int>& vertices, const std::vector<Way>& ways) {
  return Flip(atlas, site).run(vertices, ways);
}

}  // namespace gsp
