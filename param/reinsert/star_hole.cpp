#include "param/reinsert/star_hole.h"

#include <algorithm>
#include <cassert>

#include "param/removal/flatten.h"

namespace gsp {

namespace {
constexpr int kLargestFan = 96;  // faces around a vertex: three times those of a star that is ever taken out
}

bool StarHole::open(int removal) {
  assert(removal >= 0 && removal < map.decimation.size());
  map.decimation.get(removal, star, filling);
  if (!find_border()) return false;
  fill_region();
  flatten_star(map.decimation.surface->mesh.positions, star, ring);
  return true;
}

/// The half-edge from a vertex to the next one on the edge from a to b of the complex.
int StarHole::toward(int at, int a, int b) const {
  const auto share = [&](int v) { return map.is_added(v) ? map.support(v).weight_of(b) : v == b ? 1.0 : 0.0; };
  int found = -1;
  map.links.for_each_outgoing(at, map.boundary(at), [&](int h) {
    const int to = map.links.to(h);
    const bool on_edge =
        to == b || (map.is_added(to) && map.support(to).weight_of(a) > 0.0 && share(to) > 0.0 &&
                    std::count(map.support(to).weights.begin(), map.support(to).weights.end(), 0.0) == 1);
    if (on_edge && share(to) > share(at)) found = h;
  });
  return found;
}

bool StarHole::find_border() {
  border.clear();
  side_of_ring.clear();
  const int n = star.size();
  for (int k = 0; k < static_cast<int>(star.triangles.size()); ++k) {
    const int a = star.ring[k], b = star.ring[(k + 1) % n];
    side_of_ring.push_back(static_cast<int>(border.size()));
    for (int at = a; at != b; at = map.links.to(border.back().halfedge)) {
      const int h = toward(at, a, b);
      if (h < 0) return false;
      border.push_back({at, h, star.triangles[k]});
    }
  }
  if (!star.boundary) return true;
  side_of_ring.push_back(static_cast<int>(border.size()));
  border.push_back({star.ring.back(), -1, -1});
  return true;
}

void StarHole::fill_region() {
  ++stamp_;
  is_side_.resize(map.links.twin.size(), 0);
  in_region_.resize(map.links.faces.size(), 0);
  for (const Side& side : border)
    if (side.halfedge >= 0) is_side_[side.halfedge] = stamp_;
  region.assign(1, border.front().halfedge / 3);
  in_region_[region.front()] = stamp_;
  for (std::size_t i = 0; i < region.size(); ++i)
    for (int h = 3 * region[i]; h < 3 * region[i] + 3; ++h) {
      const int twin = map.links.twin[h];
      if (is_side_[h] == stamp_ || twin < 0 || in_region_[twin / 3] == stamp_) continue;
      in_region_[twin / 3] = stamp_;
      region.push_back(twin / 3);
    }
}

void StarHole::take_new_faces() {
  for (int f = static_cast<int>(in_region_.size()); f < static_cast<int>(map.links.faces.size()); ++f) {
    in_region_.push_back(stamp_);
    region.push_back(f);
  }
}

Complex StarHole::in_plane(int v) const {
  const auto corner = [&](int c) {
    const auto at = std::find(star.ring.begin(), star.ring.end(), c);
    return at == star.ring.end() ? Complex(0.0) : ring[at - star.ring.begin()];
  };
  if (!map.is_added(v)) return corner(v);
  const ReinsertionMap::Support& at = map.support(v);
  Complex z = 0.0;
  for (int k = 0; k < 3; ++k) z += at.weights[k] * corner(at.corners[k]);
  return z;
}

std::vector<int> StarHole::faces_within(int rings) const {
  std::vector<int> faces = region;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<int> vertices = map.links.vertices_of(faces);
    for (int v : vertices) {
      const std::size_t before = faces.size();
      map.links.for_each_outgoing(v, map.boundary(v), [&](int h) { faces.push_back(h / 3); });
      if (faces.size() - before > kLargestFan) faces.resize(before);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }
  return faces;
}

}  // namespace gsp
