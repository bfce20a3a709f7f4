#include "param/refined_surface.h"

#include <algorithm>

namespace gsp {

namespace {
constexpr double kSmallestPiece = 1e-9;  // of an original face
}

RefinedSurface::RefinedSurface(std::shared_ptr<const Surface> original)
    : original_(std::move(original)),
      faces_(original_->mesh.faces),
      twin_(original_->halfedges.twin),
      outgoing_(original_->halfedges.outgoing),
      origin_(faces_.size()),
      support_(original_->mesh.positions.size()) {
  for (std::size_t f = 0; f < origin_.size(); ++f) origin_[f] = static_cast<int>(f);
}

std::array<double, 3> RefinedSurface::weights_in(int v, int original_face) const {
  std::array<double, 3> weights{};
  const Support& s = support_[v];
  if (s.face >= 0) return {1.0 - s.weight[0] - s.weight[1], s.weight[0], s.weight[1]};
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * original_face + k;
    if (s.edge < 0) {
      weights[k] = original_->mesh.faces[original_face][k] == v ? 1.0 : 0.0;
    } else if (original_->edge_of[h] == s.edge) {
      const double share = original_->edge_halfedge[s.edge] == h ? s.weight[0] : 1.0 - s.weight[0];
      weights[k] = 1.0 - share;
      weights[(k + 1) % 3] = share;
      break;
    }
  }
  return weights;
}

void RefinedSurface::join(int a, int b) {
  if (a >= 0) twin_[a] = b;
  if (b >= 0) twin_[b] = a;
}

/// Cuts the face of h = (a, b), apex c, into (a, m, c) in its place and (m, b, c) as a new one.
void RefinedSurface::halve(int h, int middle) {
  const int f = h / 3, g = face_slots();
  const int b = to(h), c = from(Halfedges::prev(h)), next = Halfedges::next(h);
  faces_.push_back({middle, b, c});
  origin_.push_back(origin_[f]);
  faces_[f][next % 3] = middle;
  twin_.resize(twin_.size() + 3, -1);
  join(3 * g + 1, twin_[next]);
  join(next, 3 * g + 2);
  outgoing_[b] = 3 * g + 1;
  outgoing_[c] = 3 * g + 2;
}

/// A vertex at a place of an original face, on whose border it lies where a weight is zero.
int RefinedSurface::add_vertex(int original_face, const std::array<double, 3>& weights) {
  Support support;
  for (int k = 0; k < 3; ++k) {
    if (weights[(k + 2) % 3] != 0.0) continue;
    const int h = 3 * original_face + k;
    support.edge = original_->edge_of[h];
    support.weight[0] = original_->edge_halfedge[support.edge] == h ? weights[(k + 1) % 3] : weights[k];
  }
  if (support.edge < 0) {
    support.face = original_face;
    support.weight = {weights[1], weights[2]};
  }
  support_.push_back(support);
  outgoing_.push_back(-1);
  return vertex_count() - 1;
}

int RefinedSurface::insert(int face, const std::array<double, 3>& weights) {
  const Triangle t = faces_[face];
  std::array<double, 3> place{};
  for (int k = 0; k < 3; ++k) {
    const std::array<double, 3> w = weights_in(t[k], origin_[face]);
    for (int i = 0; i < 3; ++i) place[i] += weights[k] * w[i];
  }
  const int middle = add_vertex(origin_[face], place), second = face_slots(), third = second + 1;
  faces_[face] = {t[0], t[1], middle};
  faces_.push_back({t[1], t[2], middle});
  faces_.push_back({t[2], t[0], middle});
  const int origin = origin_[face];
  origin_.resize(faces_.size(), origin);
  twin_.resize(3 * faces_.size(), -1);
  join(3 * second, twin_[3 * face + 1]);
  join(3 * third, twin_[3 * face + 2]);
  join(3 * face + 1, 3 * second + 2);
  join(3 * second + 1, 3 * third + 2);
  join(3 * third + 1, 3 * face + 2);
  outgoing_[t[0]] = 3 * face;
  outgoing_[t[1]] = 3 * second;
  outgoing_[t[2]] = 3 * third;
  outgoing_[middle] = 3 * face + 2;
  return middle;
}

int RefinedSurface::split(int h, double share) {
  const int twin = twin_[h], a = from(h), b = to(h), face = origin_[h / 3];
  const std::array<double, 3> wa = weights_in(a, face), wb = weights_in(b, face);
  std::array<double, 3> w;
  for (int k = 0; k < 3; ++k) w[k] = (1.0 - share) * wa[k] + share * wb[k];
  const int middle = add_vertex(face, w);
  halve(h, middle);
  const int second = 3 * (face_slots() - 1);  // (m, b)
  halve(twin, middle);
  const int fourth = 3 * (face_slots() - 1);  // (m, a)
  join(h, fourth);
  join(second, twin);
  outgoing_[middle] = second;
  outgoing_[a] = h;
  outgoing_[b] = twin;
  return middle;
}

RefinedSurface::Snapshot RefinedSurface::snapshot(const std::vector<int>& faces, const std::vector<int>& vertices) const {
  Snapshot snapshot;
  snapshot.faces_ = faces;
  snapshot.vertices_ = vertices;
  for (int f : faces) {
    snapshot.corners_.push_back(faces_[f]);
    for (int k = 0; k < 3; ++k) snapshot.twin_.push_back(twin_[3 * f + k]);
  }
  for (int v : vertices) snapshot.outgoing_.push_back(outgoing_[v]);
  snapshot.face_slots_ = face_slots();
  snapshot.vertex_count_ = vertex_count();
  return snapshot;
}

void RefinedSurface::restore(const Snapshot& snapshot) {
  faces_.resize(snapshot.face_slots_);
  origin_.resize(snapshot.face_slots_);
  twin_.resize(3 * static_cast<std::size_t>(snapshot.face_slots_));
  support_.resize(snapshot.vertex_count_);
  outgoing_.resize(snapshot.vertex_count_);
  for (std::size_t i = 0; i < snapshot.faces_.size(); ++i) {
    const int f = snapshot.faces_[i];
    faces_[f] = snapshot.corners_[i];
    for (int k = 0; k < 3; ++k) join(3 * f + k, snapshot.twin_[3 * i + k]);
  }
  for (std::size_t i = 0; i < snapshot.vertices_.size(); ++i) outgoing_[snapshot.vertices_[i]] = snapshot.outgoing_[i];
}

bool RefinedSurface::can_collapse(int h) const {
  const int m = from(h), n = to(h);
  if (!added(m)) return false;
  const int face = origin_[h / 3];
  if (support_[m].edge >= 0) {
    bool along = false;
    for (int k = 0; k < 3; ++k)
      along |= original_->edge_of[3 * face + k] == support_[m].edge && weights_in(n, face)[(k + 2) % 3] == 0.0;
    if (!along) return false;
  }
  const int c = from(Halfedges::prev(h)), d = from(Halfedges::prev(twin_[h]));
  bool possible = true;
  for_each_outgoing(m, [&](int out) {
    const int x = to(out), y = from(Halfedges::prev(out));
    if (!possible || x == n || y == n) return;
    const auto wn = weights_in(n, origin_[out / 3]), wx = weights_in(x, origin_[out / 3]),
               wy = weights_in(y, origin_[out / 3]);
    const double area = (wx[1] - wn[1]) * (wy[2] - wn[2]) - (wx[2] - wn[2]) * (wy[1] - wn[1]);
    possible &= area > kSmallestPiece;
    // A new edge between two vertices of a boundary would leave its face no area where the boundary is straight.
    possible &= !boundary(n) || !(boundary(x) || boundary(y));
  });
  if (!possible) return false;
  // The two ends may share no neighbours but those of the two faces that die.
  for_each_outgoing(n, [&](int out) {
    const int w = to(out);
    if (w == m || w == c || w == d) return;
    for_each_outgoing(m, [&](int other) { possible &= to(other) != w; });
  });
  return possible;
}

void RefinedSurface::collapse(int h) {
  const int m = from(h), n = to(h);
  std::vector<int> around;
  for_each_outgoing(m, [&](int out) { around.push_back(out); });
  for (int out : around) faces_[out / 3][out % 3] = n;
  for (int side : {h, twin_[h]}) {
    const int after = twin_[Halfedges::next(side)], before = twin_[Halfedges::prev(side)];
    join(after, before);
    for (int out : {after, before}) {
      if (out < 0) continue;
      outgoing_[from(out)] = out;
      outgoing_[to(out)] = twin_[out] >= 0 ? twin_[out] : Halfedges::next(out);
    }
  }
  faces_[h / 3] = faces_[twin_[h] / 3] = {-1, -1, -1};
  outgoing_[m] = -1;
}

RefinedSurface::Compact RefinedSurface::compact() const {
  Compact result;
  const Mesh& mesh = original_->mesh;
  result.mesh.positions = mesh.positions;
  result.vertex.assign(vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) result.vertex[v] = v;
  std::vector<int> slots(mesh.faces.size(), -1);
  std::vector<int> further;
  for (int f = 0; f < face_slots(); ++f) {
    if (!alive(f)) continue;
    if (slots[origin_[f]] < 0)
      slots[origin_[f]] = f;
    else
      further.push_back(f);
  }
  slots.insert(slots.end(), further.begin(), further.end());
  for (int v = mesh.vertex_count(); v < vertex_count(); ++v) {
    if (outgoing_[v] < 0) continue;
    const int face = origin_[outgoing_[v] / 3];
    const auto w = weights_in(v, face);
    const Triangle& t = mesh.faces[face];
    result.vertex[v] = result.mesh.vertex_count();
    result.mesh.positions.push_back(w[0] * mesh.positions[t[0]] + w[1] * mesh.positions[t[1]] +
                                    w[2] * mesh.positions[t[2]]);
  }
  for (int f : slots) {
    const Triangle& t = faces_[f];
    result.mesh.faces.push_back({result.vertex[t[0]], result.vertex[t[1]], result.vertex[t[2]]});
    for (int k = 0; k < 3; ++k) result.halfedge.push_back(3 * f + k);
  }
  return result;
}

}  // namespace gsp
