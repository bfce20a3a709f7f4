#include "param/refine.h"

#include <cmath>

#include "mesh/error.h"

namespace gsp {

namespace {

/// Largest mean angle of the faces around a corner before its link is split: the limit is 3 sectors, 180°.
constexpr double kMostSectorsPerFace = 1.25;

/// The lattice motion that takes one pair of distinct points to another.
Transition motion_of(Complex from0, Complex from1, Complex to0, Complex to1) {
  const double turn = std::arg((to1 - to0) / (from1 - from0)) / (std::acos(-1.0) / 3.0);
  Transition t;
  t.rotation = ((static_cast<int>(std::lround(turn)) % 6) + 6) % 6;
  const Complex shift = to0 - omega_power(t.rotation) * from0;
  t.translation.b = static_cast<int>(std::lround(shift.imag() / kOmegaIm));
  t.translation.a = static_cast<int>(std::lround(shift.real() - kOmegaRe * t.translation.b));
  return t;
}

/// A surface that grows, with one transition per half-edge (from the chart of its head to that of its tail).
class Refiner {
 public:
  explicit Refiner(const Atlas& atlas)
      : atlas_(atlas), mesh_(atlas.surface->mesh), twin_(atlas.surface->halfedges.twin) {
    for (int h = 0; h < static_cast<int>(twin_.size()); ++h) {
      const int edge = atlas.surface->edge_of[h];
      transition_.push_back(atlas.towards(edge, atlas.surface->edge_halfedge[edge] == h));
    }
  }

  void split(int edge);
  Atlas finish();

 private:
  int from(int h) const { return mesh_.faces[h / 3][h % 3]; }
  Transition opposite_transition(int h, int tail, const Transition& to_tail) const;
  void halve(int h, int middle, const Transition& to_apex);
  void join(int a, int b) {
    twin_[a] = b;
    if (b >= 0) twin_[b] = a;
  }

  Atlas atlas_;
  Mesh mesh_;
  std::vector<int> twin_;
  std::vector<Transition> transition_;
};

/// From the chart of the apex behind half-edge h into the chart of `tail` (an end of h), seen through h's face such that
/// the other end of h lies where `to_tail` puts it.
Transition Refiner::opposite_transition(int h, int tail, const Transition& to_tail) const {
  const int start = from(h), head = from(Halfedges::next(h)), apex = from(Halfedges::prev(h));
  const int other = tail == start ? head : start;
  const Transition tail_to_apex_edge =
      tail == start ? transition_[Halfedges::prev(h)].inverse() : transition_[Halfedges::next(h)];
  if (atlas_.corner[tail] < 0) return tail_to_apex_edge;
  if (atlas_.corner[other] < 0) {
    const Transition other_to_apex =
        tail == start ? transition_[Halfedges::next(h)] : transition_[Halfedges::prev(h)].inverse();
    return to_tail * other_to_apex;
  }
  // Both ends are corners, whose transitions hold up to turns: compare the face's own frame with the edge's.
  Atlas::FaceFrame frame;
  std::array<Transition, 3> to_frame;
  if (atlas_.corner[apex] < 0) {
    to_frame[0] = transition_[Halfedges::prev(h)];            // start -> apex's chart
    to_frame[1] = transition_[Halfedges::next(h)].inverse();  // head -> apex's chart
    const Transition& tail_frame = tail == start ? to_frame[0] : to_frame[1];
    const Transition& other_frame = tail == start ? to_frame[1] : to_frame[0];
    return motion_of(tail_frame.apply(atlas_.position[tail]), other_frame.apply(atlas_.position[other]),
                     atlas_.position[tail], to_tail.apply(atlas_.position[other]));
  }
  // Three corners: such a face is one of the input's own, so the atlas can still frame it.
  frame = atlas_.face_frame(h / 3);
  const int k = h % 3;
  const int tail_k = tail == start ? k : (k + 1) % 3, other_k = tail == start ? (k + 1) % 3 : k;
  const Transition motion =
      motion_of(frame.to_chart[tail_k].apply(atlas_.position[tail]), frame.to_chart[other_k].apply(atlas_.position[other]),
                atlas_.position[tail], to_tail.apply(atlas_.position[other]));
  return motion * frame.to_chart[(k + 2) % 3];
}

/// Cuts the face of h = (a, b), apex c, into (a, m, c) in its place and (m, b, c) as a new one.
void Refiner::halve(int h, int middle, const Transition& to_apex) {
  const int f = h / 3, k = h % 3;
  const int g = mesh_.face_count();
  const int b = mesh_.faces[f][(k + 1) % 3], c = mesh_.faces[f][(k + 2) % 3];
  const int next = Halfedges::next(h);
  mesh_.faces.push_back({middle, b, c});
  mesh_.faces[f][(k + 1) % 3] = middle;
  twin_.resize(twin_.size() + 3);
  transition_.resize(transition_.size() + 3);
  join(3 * g + 1, twin_[next]);
  transition_[3 * g + 1] = transition_[next];
  join(next, 3 * g + 2);  // (m, c) in the old face, (c, m) in the new one
  transition_[next] = to_apex;
  transition_[3 * g + 2] = to_apex.inverse();
}

void Refiner::split(int edge) {
  const int h = atlas_.surface->edge_halfedge[edge], twin = twin_[h];
  const int a = from(h), b = from(Halfedges::next(h)), m = mesh_.vertex_count();
  // The new vertex takes the chart of an end, and the edge's own transition tells where the other end lies in it.
  const bool at_start = atlas_.corner[a] < 0 || atlas_.corner[b] >= 0;
  const int tail = at_start ? a : b, other = at_start ? b : a;
  const Transition to_tail = at_start ? transition_[h] : transition_[h].inverse();
  const Transition apex = opposite_transition(h, tail, to_tail);
  const Transition twin_apex = twin < 0 ? Transition{} : opposite_transition(twin, tail, to_tail);
  mesh_.positions.push_back(0.5 * (mesh_.positions[a] + mesh_.positions[b]));
  atlas_.patch.push_back(atlas_.patch[tail]);
  atlas_.position.push_back(0.5 * (atlas_.position[tail] + to_tail.apply(atlas_.position[other])));
  atlas_.corner.push_back(-1);
  const Transition m_to_a = at_start ? Transition{} : to_tail.inverse();  // from m's chart to a's
  const Transition m_to_b = at_start ? to_tail.inverse() : Transition{};
  halve(h, m, apex);
  const int second = 3 * (mesh_.face_count() - 1);  // (m, b)
  transition_[h] = m_to_a;
  transition_[second] = m_to_b.inverse();
  twin_[second] = -1;
  if (twin < 0) return;
  halve(twin, m, twin_apex);  // (b, m, d) in place, (m, a, d) new
  const int fourth = 3 * (mesh_.face_count() - 1);
  transition_[twin] = m_to_b;
  transition_[fourth] = m_to_a.inverse();
  join(h, fourth);
  join(second, twin);
}

Atlas Refiner::finish() {
  atlas_.surface = std::make_shared<const Surface>(std::move(mesh_));
  atlas_.transition.clear();
  for (int h : atlas_.surface->edge_halfedge) atlas_.transition.push_back(transition_[h]);
  for (int v = 0; v < static_cast<int>(atlas_.patch.size()); ++v)
    if (atlas_.patch[v] >= 0 && atlas_.corner[v] < 0 && !atlas_.surface->halfedges.boundary_vertex(v)) atlas_.reassign(v);
  return std::move(atlas_);
}

int faces_around(const Surface& surface, int v) {
  int neighbours = 0;
  surface.for_each_neighbour(v, [&](int, int, bool) { ++neighbours; });
  return neighbours - (surface.halfedges.boundary_vertex(v) ? 1 : 0);
}

}  // namespace

void split_edges(Atlas& atlas, const std::vector<int>& edges) {
  if (edges.empty()) return;
  Refiner refiner(atlas);
  for (int edge : edges) refiner.split(edge);
  atlas = refiner.finish();
}

int refine_at_corners(Atlas& atlas) {
  const int before = atlas.surface->mesh.vertex_count();
  std::vector<int> edges;
  for (int e = 0; e < atlas.surface->edge_count(); ++e) {
    const int h = atlas.surface->edge_halfedge[e];
    const int a = atlas.surface->halfedges.from(h), b = atlas.surface->halfedges.to(h);
    if (atlas.corner[a] < 0 || atlas.corner[b] < 0) continue;
    const double length = std::abs(atlas.transition[e].apply(atlas.position[b]) - atlas.position[a]);
    if (std::abs(length - 1.0) > 1e-6) edges.push_back(e);
  }
  split_edges(atlas, edges);
  for (;;) {
    const Surface& surface = *atlas.surface;
    std::vector<char> chosen(surface.edge_count(), 0);
    edges.clear();
    for (int b = 0; b < atlas.base.vertex_count(); ++b) {
      const int v = atlas.base.vertices[b];
      if (atlas.fans[b].valence() <= kMostSectorsPerFace * faces_around(surface, v)) continue;
      const int start = surface.halfedges.outgoing[v];
      int h = start;
      do {
        const int edge = surface.edge_of[Halfedges::next(h)];
        if (!chosen[edge]) edges.push_back(edge);
        chosen[edge] = 1;
        h = surface.halfedges.rotate_ccw(h);
      } while (h >= 0 && h != start);
    }
    if (edges.empty()) break;
    split_edges(atlas, edges);
  }
  return atlas.surface->mesh.vertex_count() - before;
}

}  // namespace gsp
