#include "param/reinsert/insert_by_cutting.h"

#include <algorithm>
#include <map>

#include "param/removal/flatten.h"

namespace gsp {

namespace {

constexpr double kBeside = 0.02;  // of an edge or triangle, nearer than which a vertex goes onto the line beside it
constexpr double kSliver = 1e-4;  // thickness of a piece in the star's plane that still does
constexpr int kThinnings = 3;

class StarCut {
 public:
  explicit StarCut(StarHole& hole) : hole_(hole), map_(hole.map) {}
  bool run();

 private:
  bool seat_on_side();
  bool seat_center();
  bool cut_toward(int target);
  void thin();
  void settle();

  StarHole& hole_;
  ReinsertionMap& map_;
  std::map<int, Complex> plane_;  ///< where the hole's vertices lie in the plane of the star
  std::map<int, int> on_edge_;  ///< added vertices on the star's edges, and the edges' ends; -1 for those on the border
};

/// Puts the centre onto the boundary between the ends of its ring.
bool StarCut::seat_on_side() {
  const int first = hole_.star.ring.front(), last = hole_.star.ring.back(), center = hole_.star.center;
  int side = -1;
  map_.links.for_each_outgoing(last, true, [&](int h) {
    if (map_.links.to(h) == first && map_.links.twin[h] < 0) side = h;
  });
  if (side < 0) return false;
  plane_[center] = 0.0;
  if (!map_.split(side, hole_.share_of_boundary(), center)) return false;
  if (map_.loose.corner[first] < 0 || map_.loose.corner[last] < 0) return true;
  Complex at_first = 0.0, at_last = 0.0;
  map_.links.for_each_outgoing(center, true, [&](int h) {
    const auto [next, before] = map_.loose.link(map_.links, h);
    if (map_.links.to(h) == first) at_first = next;
    if (map_.links.from(Halfedges::prev(h)) == last) at_last = before;
  });
  const auto seat = map_.boundary_seat(last, first, at_last, at_first);
  if (seat) map_.change_chart(center, *seat);
  return seat.has_value();
}

/// Puts the centre into the piece that holds 0, or onto an edge that is near.
bool StarCut::seat_center() {
  if (hole_.star.boundary) return seat_on_side();
  int face = -1;
  std::array<double, 3> weights{};
  double most = -1e300;
  for (int f : hole_.region) {
    const Triangle& t = map_.links.faces[f];
    const auto w = barycentric(0.0, plane_[t[0]], plane_[t[1]], plane_[t[2]]);
    const double least = std::min({w[0], w[1], w[2]});
    if (!(least > most)) continue;
    most = least;
    face = f;
    weights = w;
  }
  if (face < 0) return false;
  const int least = static_cast<int>(std::min_element(weights.begin(), weights.end()) - weights.begin());
  const int side = 3 * face + (least + 1) % 3, twin = map_.links.twin[side];
  plane_[hole_.star.center] = 0.0;
  if (most < kBeside && twin >= 0 && hole_.holds(twin / 3)) {
    const Complex a = plane_[map_.links.from(side)], b = plane_[map_.links.to(side)];
    const Complex behind = plane_[map_.links.from(Halfedges::prev(twin))];
    const double share = weights[(least + 2) % 3] / (1.0 - weights[least]);
    if (share > 0.0 && share < 1.0 && chart_area(0.0, a, behind) > 0.0 && chart_area(0.0, behind, b) > 0.0)
      return map_.split(side, share, hole_.star.center);
  }
  if (!(most > 0.0)) return false;
  map_.insert(face, weights, hole_.star.center);
  return true;
}

/// Cuts the pieces along the straight line from the centre to a ring vertex.
bool StarCut::cut_toward(int target) {
  for (int at = hole_.star.center; at != target;) {
    const Complex direction = plane_[target] - plane_[at];
    int crossed = -1;
    double share = 0.0;
    bool found = false;
    map_.links.for_each_outgoing(at, map_.boundary(at), [&](int h) {
      if (found || !hole_.holds(h / 3)) return;
      const int p = map_.links.to(h), q = map_.links.from(Halfedges::prev(h));
      found = p == target || q == target;
      const double right = cross(direction, plane_[p] - plane_[at]), left = cross(direction, plane_[q] - plane_[at]);
      if (found || crossed >= 0 || right > 0.0 || left <= 0.0) return;
      crossed = Halfedges::next(h);
      share = right / (right - left);
    });
    if (found) return true;
    const int twin = crossed < 0 ? -1 : map_.links.twin[crossed];
    if (twin < 0 || !hole_.holds(twin / 3)) return false;
    const int p = map_.links.from(crossed), q = map_.links.to(crossed);
    const Complex place = (1.0 - share) * plane_[p] + share * plane_[q];
    // An added vertex that is near goes onto the line instead, if that leaves its pieces upright.
    const auto draw = [&](int v, double far) {
      if (far > kBeside || !map_.is_added(v) || on_edge_.count(v)) return false;
      bool possible = true;
      map_.links.for_each_outgoing(v, false, [&](int h) {
        possible = possible && hole_.holds(h / 3) &&
                   thickness(place, plane_[map_.links.to(h)], plane_[map_.links.from(Halfedges::prev(h))]) > kSliver;
      });
      if (possible) plane_[v] = place;
      return possible;
    };
    if (draw(p, share)) {
      at = p;
    } else if (draw(q, 1.0 - share)) {
      at = q;
    } else {
      if (!(share > 0.0 && share < 1.0)) return false;
      at = map_.add_vertex();
      if (!map_.split(crossed, share, at)) return false;
      plane_[at] = place;
      hole_.take_new_faces();
    }
    on_edge_[at] = target;
  }
  return true;
}

/// Takes added vertices that the cuts have left out again.
void StarCut::thin() {
  TriangleLinks& links = map_.links;
  const auto edge_of = [&](int v) {
    const auto at = on_edge_.find(v);
    return at == on_edge_.end() ? -1 : at->second;
  };
  for (int pass = 0; pass < kThinnings; ++pass)
    for (auto at = plane_.begin(); at != plane_.end();) {
      const int v = at->first, edge = edge_of(v);
      ++at;
      if (!map_.is_added(v) || (on_edge_.count(v) && edge < 0)) continue;
      const auto in_map = [&](int out) { return map_.loose.link(links, out); };
      const auto in_star = [&](int out) {
        return std::pair(plane_[links.to(out)], plane_[links.from(Halfedges::prev(out))]);
      };
      const int along = links.collapsible(v, map_.loose.position[v], in_map, [&](int h) {
        const int n = links.to(h);
        if (on_edge_.count(v) && n != hole_.star.center && n != edge && edge_of(n) != edge) return false;
        return links.stays_thick(h, plane_[n], kSliver, in_star) && links.ends_apart(h, map_.boundary(n));
      });
      if (along < 0) continue;
      map_.loose.draw(links, along);
      links.collapse(along);
      plane_.erase(v);
    }
  std::vector<int>& region = hole_.region;
  region.erase(std::remove_if(region.begin(), region.end(), [&](int f) { return !links.alive(f); }), region.end());
}

/// Gives the pieces in the hole to the star's triangles, and the added vertices in it their places there.
void StarCut::settle() {
  const Star& star = hole_.star;
  const int n = star.size(), wedges = static_cast<int>(star.triangles.size());
  for (int f : hole_.region) {
    Complex middle = 0.0;
    for (int v : map_.links.faces[f]) middle += plane_.at(v) / 3.0;
    double most = -1e300;
    for (int k = 0; k < wedges; ++k) {
      const auto w = barycentric(middle, 0.0, hole_.ring[k], hole_.ring[(k + 1) % n]);
      if (std::min(w[1], w[2]) <= most) continue;
      most = std::min(w[1], w[2]);
      map_.slot[f] = star.triangles[k];
    }
  }
  for (const auto& [v, at] : plane_) {
    if (!map_.is_added(v)) continue;
    const auto target = on_edge_.find(v);
    if (target != on_edge_.end() && target->second < 0) continue;  // on the border
    ReinsertionMap::Support& support = map_.added[v - map_.own_vertices()];
    if (target != on_edge_.end()) {
      const double share = std::abs(at) / std::abs(hole_.in_plane(target->second));
      const int k = static_cast<int>(std::find(star.ring.begin(), star.ring.end(), target->second) - star.ring.begin());
      support = {{star.center, star.ring[k], star.ring[(k + 1) % n]}, {1.0 - share, share, 0.0}};
      continue;
    }
    double most = -1e300;
    for (int k = 0; k < wedges; ++k) {
      const auto w = barycentric(at, 0.0, hole_.ring[k], hole_.ring[(k + 1) % n]);
      const double least = std::min({w[0], w[1], w[2]});
      if (least <= most) continue;
      most = least;
      support = {{star.center, star.ring[k], star.ring[(k + 1) % n]}, w};
    }
  }
}

bool StarCut::run() {
  for (int f : hole_.region)
    for (int v : map_.links.faces[f]) plane_[v] = hole_.in_plane(v);
  for (int f : hole_.region) {
    const Triangle& t = map_.links.faces[f];
    if (!(chart_area(plane_[t[0]], plane_[t[1]], plane_[t[2]]) > 0.0)) return false;
  }
  for (const StarHole::Side& side : hole_.border)
    if (map_.is_added(side.vertex)) on_edge_[side.vertex] = -1;
  if (!seat_center()) return false;
  hole_.take_new_faces();
  for (int k = hole_.star.boundary; k + hole_.star.boundary < hole_.star.size(); ++k)  // not along a boundary
    if (!cut_toward(hole_.star.ring[k])) return false;
  thin();
  settle();
  return true;
}

}  // namespace

bool cut_in(StarHole& hole) { return StarCut(hole).run(); }

}  // namespace gsp
