#pragma once

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "mesh/halfedges.h"
#include "mesh/mesh.h"
#include "param/atlas/surface.h"
#include "param/map/lattice.h"

namespace gsp {

constexpr double kThin = 0.05;  ///< `thickness` below which a piece of a surface is not made,
constexpr double kWorse = 0.5;  ///< unless it becomes no thinner than this share of before

/// Height over longest side of a triangle in the plane; not positive where it is not upright.
inline double thickness(Complex a, Complex b, Complex c) {
  return cross(b - a, c - a) / std::max({std::norm(b - a), std::norm(c - b), std::norm(a - c), 1e-300});
}

/// Triangles that come and go, with the links between them: half-edge h = 3f + k runs from corner k of face f to the
/// next.
struct TriangleLinks {
  std::vector<Triangle> faces;  ///< corner 0 of a dead one is -1
  std::vector<int> twin;        ///< #3F, -1 on a boundary
  std::vector<int> outgoing;    ///< #V a half-edge that leaves the vertex, -1 where there is none

  int from(int h) const { return faces[h / 3][h % 3]; }
  int to(int h) const { return from(Halfedges::next(h)); }
  bool alive(int face) const { return faces[face][0] >= 0; }

  /// The vertices of some faces, ascending.
  std::vector<int> vertices_of(const std::vector<int>& some) const { return gsp::vertices_of(faces, some); }

  void join(int a, int b) {
    if (a >= 0) twin[a] = b;
    if (b >= 0) twin[b] = a;
  }

  /// Cuts the face of h = (a, b), apex c, into (a, m, c) in its place and (m, b, c) as a new one, the last, with
  /// half-edges in that order. Its links across (a, m) and (m, b) are left to the caller.
  void halve(int h, int middle) {
    const int f = h / 3, g = static_cast<int>(faces.size());
    const int b = to(h), c = from(Halfedges::prev(h)), next = Halfedges::next(h);
    faces.push_back({middle, b, c});
    faces[f][next % 3] = middle;
    twin.resize(twin.size() + 3, -1);
    join(3 * g + 1, twin[next]);
    join(next, 3 * g + 2);
    outgoing[b] = 3 * g + 1;
    outgoing[c] = 3 * g + 2;
  }

  /// Halves both faces at the edge of h = (a, b), which has a twin, or the one where it is on a boundary: h becomes (a,
  /// m), its twin (b, m).
  void split(int h, int middle) {
    const int other = twin[h], a = from(h), b = to(h);
    halve(h, middle);
    const int second = 3 * (static_cast<int>(faces.size()) - 1);  // (m, b)
    outgoing[middle] = second;
    outgoing[a] = h;
    if (other < 0) return;
    halve(other, middle);
    const int fourth = 3 * (static_cast<int>(faces.size()) - 1);  // (m, a)
    join(h, fourth);
    join(second, other);
    outgoing[b] = other;
  }

  /// Cuts a face into three around a vertex: it keeps its first side, two new faces, the last, get the others, from the
  /// second on.
  void insert(int face, int middle) {
    const Triangle t = faces[face];
    const int second = static_cast<int>(faces.size()), third = second + 1;
    faces[face] = {t[0], t[1], middle};
    faces.push_back({t[1], t[2], middle});
    faces.push_back({t[2], t[0], middle});
    twin.resize(3 * faces.size(), -1);
    join(3 * second, twin[3 * face + 1]);
    join(3 * third, twin[3 * face + 2]);
    join(3 * face + 1, 3 * second + 2);
    join(3 * second + 1, 3 * third + 2);
    join(3 * third + 1, 3 * face + 2);
    outgoing[t[0]] = 3 * face;
    outgoing[t[1]] = 3 * second;
    outgoing[t[2]] = 3 * third;
    outgoing[middle] = 3 * face + 2;
  }

  /// Whether the ends of h, which has a twin, share no neighbours but those of the two faces at it; then the first,
  /// which is on no boundary, can be drawn onto the second. `boundary`: whether the second is on one.
  bool ends_apart(int h, bool boundary) const {
    const int m = from(h), n = to(h), c = from(Halfedges::prev(h)), d = from(Halfedges::prev(twin[h]));
    bool apart = true;
    for_each_outgoing(n, boundary, [&](int out) {
      const int w = to(out);
      if (w == m || w == c || w == d) return;
      for_each_outgoing(m, false, [&](int other) { apart &= to(other) != w; });
    });
    return apart;
  }

  /// Draws from(h) onto to(h): the two faces at h die.
  void collapse(int h) {
    assert(twin[h] >= 0);
    const int m = from(h), n = to(h);
    std::vector<int> around;
    for_each_outgoing(m, false, [&](int out) { around.push_back(out); });
    for (int out : around) faces[out / 3][out % 3] = n;
    for (int side : {h, twin[h]}) {
      const int after = twin[Halfedges::next(side)], before = twin[Halfedges::prev(side)];
      join(after, before);
      for (int out : {after, before}) {
        if (out < 0) continue;
        outgoing[from(out)] = out;
        outgoing[to(out)] = twin[out] >= 0 ? twin[out] : Halfedges::next(out);
      }
    }
    faces[h / 3] = faces[twin[h] / 3] = {-1, -1, -1};
    outgoing[m] = -1;
  }

  /// A half-edge along which v, which is on no boundary, can be drawn onto a neighbour such that a map into the plane
  /// stays upright, its pieces thick enough or hardly thinner than before, and which `allowed(h)`; -1 where there is
  /// none. v lies at `center`, and link(out) gives the two other corners, in order, of the face of a half-edge `out`
  /// that leaves it.
  template <class Link, class Allowed>
  int collapsible(int v, Complex center, Link&& link, Allowed&& allowed) const {
    double before = 1.0;
    for_each_outgoing(v, false, [&](int h) {
      const auto [x, y] = link(h);
      before = std::min(before, thickness(center, x, y));
    });
    const double least = std::min(kThin, kWorse * before);
    int along = -1;
    for_each_outgoing(v, false, [&](int h) {
      if (along < 0 && stays_thick(h, link(h).first, least, link) && allowed(h)) along = h;
    });
    return along;
  }

  /// Whether the faces around from(h) but those at h are thicker than `least` with it at `goal`.
  template <class Link>
  bool stays_thick(int h, Complex goal, double least, Link&& link) const {
    const int n = to(h);
    bool thick = true;
    for_each_outgoing(from(h), false, [&](int out) {
      if (!thick || to(out) == n || from(Halfedges::prev(out)) == n) return;
      const auto [x, y] = link(out);
      thick = thickness(goal, x, y) > least;
    });
    return thick;
  }

  /// Calls visit(h) for the half-edges that leave v, counter-clockwise. `boundary`: whether v is on one; its last
  /// neighbour has no half-edge then.
  template <class Visit>
  void for_each_outgoing(int v, bool boundary, Visit&& visit) const {
    int h = outgoing[v];
    if (h < 0) return;
    if (boundary)  // back to the first face of the fan
      while (twin[h] >= 0) h = Halfedges::next(twin[h]);
    const int start = h;
    do {
      visit(h);
      h = twin[Halfedges::prev(h)];
    } while (h >= 0 && h != start);
  }
};

}  // namespace gsp
