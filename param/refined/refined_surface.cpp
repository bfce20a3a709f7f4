#include "param/refined/refined_surface.h"

#include <algorithm>
#include <cassert>

namespace gsp {

namespace {
constexpr double kSmallestPiece = 1e-9;  // of an original face
}

RefinedSurface::RefinedSurface(std::shared_ptr<const Surface> original)
    : original_(std::move(original)),
      links_{original_->mesh.faces, original_->halfedges.twin, original_->halfedges.outgoing},
      origin_(links_.faces.size()),
      support_(original_->mesh.positions.size()) {
  for (std::size_t f = 0; f < origin_.size(); ++f) origin_[f] = static_cast<int>(f);
}

RefinedSurface::RefinedSurface(std::shared_ptr<const Surface> original, TriangleLinks links, std::vector<int> origin,
                               const std::vector<Point>& added)
    : original_(std::move(original)),
      links_(std::move(links)),
      origin_(std::move(origin)),
      support_(original_->mesh.positions.size()) {
  for (const Point& at : added) support_.push_back(support_of(at));
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

RefinedSurface::Support RefinedSurface::support_of(const Point& at) const {
  Support support;
  for (int k = 0; k < 3; ++k) {
    if (at.weights[(k + 2) % 3] != 0.0) continue;
    const int h = 3 * at.face + k;
    support.edge = original_->edge_of[h];
    support.weight[0] = original_->edge_halfedge[support.edge] == h ? at.weights[(k + 1) % 3] : at.weights[k];
  }
  if (support.edge < 0) {
    support.face = at.face;
    support.weight = {at.weights[1], at.weights[2]};
  }
  return support;
}

int RefinedSurface::add_vertex(const Point& at) {
  support_.push_back(support_of(at));
  links_.outgoing.push_back(-1);
  return vertex_count() - 1;
}

int RefinedSurface::insert(int face, const std::array<double, 3>& weights) {
  assert(alive(face));
  const Triangle t = links_.faces[face];
  std::array<double, 3> place{};
  for (int k = 0; k < 3; ++k) {
    const std::array<double, 3> w = weights_in(t[k], origin_[face]);
    for (int i = 0; i < 3; ++i) place[i] += weights[k] * w[i];
  }
  const int middle = add_vertex({origin_[face], place}), origin = origin_[face];
  links_.insert(face, middle);
  origin_.resize(links_.faces.size(), origin);
  return middle;
}

int RefinedSurface::split(int h, double share) {
  assert(links_.twin[h] >= 0 && share > 0.0 && share < 1.0);
  const int face = origin_[h / 3], other = origin_[links_.twin[h] / 3];
  const std::array<double, 3> wa = weights_in(from(h), face), wb = weights_in(to(h), face);
  std::array<double, 3> w;
  for (int k = 0; k < 3; ++k) w[k] = (1.0 - share) * wa[k] + share * wb[k];
  const int middle = add_vertex({face, w});
  links_.split(h, middle);
  origin_.push_back(face);
  origin_.push_back(other);
  return middle;
}

RefinedSurface::Snapshot RefinedSurface::snapshot(const std::vector<int>& faces,
                                                  const std::vector<int>& vertices) const {
  Snapshot snapshot;
  snapshot.faces_ = faces;
  snapshot.vertices_ = vertices;
  for (int f : faces) {
    snapshot.corners_.push_back(links_.faces[f]);
    for (int k = 0; k < 3; ++k) snapshot.twin_.push_back(links_.twin[3 * f + k]);
  }
  for (int v : vertices) snapshot.outgoing_.push_back(links_.outgoing[v]);
  snapshot.face_slots_ = face_slots();
  snapshot.vertex_count_ = vertex_count();
  return snapshot;
}

void RefinedSurface::restore(const Snapshot& snapshot) {
  links_.faces.resize(snapshot.face_slots_);
  origin_.resize(snapshot.face_slots_);
  links_.twin.resize(3 * static_cast<std::size_t>(snapshot.face_slots_));
  support_.resize(snapshot.vertex_count_);
  links_.outgoing.resize(snapshot.vertex_count_);
  for (std::size_t i = 0; i < snapshot.faces_.size(); ++i) {
    const int f = snapshot.faces_[i];
    links_.faces[f] = snapshot.corners_[i];
    for (int k = 0; k < 3; ++k) links_.join(3 * f + k, snapshot.twin_[3 * i + k]);
  }
  for (std::size_t i = 0; i < snapshot.vertices_.size(); ++i)
    links_.outgoing[snapshot.vertices_[i]] = snapshot.outgoing_[i];
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
  return possible && links_.ends_apart(h, boundary(n));
}

void RefinedSurface::collapse(int h) {
  assert(can_collapse(h));
  links_.collapse(h);
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
    if (links_.outgoing[v] < 0) continue;
    const int face = origin_[links_.outgoing[v] / 3];
    const auto w = weights_in(v, face);
    const Triangle& t = mesh.faces[face];
    result.vertex[v] = result.mesh.vertex_count();
    result.mesh.positions.push_back(w[0] * mesh.positions[t[0]] + w[1] * mesh.positions[t[1]] +
                                    w[2] * mesh.positions[t[2]]);
  }
  for (int f : slots) {
    const Triangle& t = links_.faces[f];
    result.mesh.faces.push_back({result.vertex[t[0]], result.vertex[t[1]], result.vertex[t[2]]});
    for (int k = 0; k < 3; ++k) result.halfedge.push_back(3 * f + k);
  }
  return result;
}

}  // namespace gsp
