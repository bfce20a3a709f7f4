#include "param/coarsen.h"

namespace gsp {

namespace {

constexpr int kPasses = 3;  // a vertex may have to wait for its neighbours

class Coarsener {
 public:
  explicit Coarsener(RefinedMap map)
      : map_(std::move(map)),
        refined_(map_.refined),
        patch_(refined_.vertex_count(), -1),
        corner_(refined_.vertex_count(), -1),
        position_(refined_.vertex_count()),
        transition_(3 * static_cast<std::size_t>(refined_.face_slots())) {
    const Atlas& atlas = map_.atlas;
    for (int v = 0; v < refined_.vertex_count(); ++v) {
      if (map_.vertex[v] < 0) continue;
      patch_[v] = atlas.patch[map_.vertex[v]];
      position_[v] = atlas.position[map_.vertex[v]];
      corner_[v] = atlas.corner[map_.vertex[v]];
    }
    const Surface& surface = *atlas.surface;
    for (std::size_t h = 0; h < map_.halfedge.size(); ++h)
      transition_[map_.halfedge[h]] =
          atlas.towards(surface.edge_of[h], surface.edge_halfedge[surface.edge_of[h]] == static_cast<int>(h));
  }

  /// Draws an added vertex onto a neighbour if it can be; tells whether it could.
  bool take_out(int v) {
    const auto link = [&](int out) {
      const int back = Halfedges::prev(out);
      return std::pair(transition_[out].apply(position_[refined_.to(out)]),
                       transition_[back].inverse().apply(position_[refined_.from(back)]));
    };
    const int along = refined_.collapsible(v, position_[v], link);
    if (along < 0) return false;
    const Transition to_v = transition_[along], from_v = to_v.inverse();
    refined_.for_each_outgoing(v, [&](int out) {
      transition_[out] = from_v * transition_[out];
      transition_[Halfedges::prev(out)] = transition_[Halfedges::prev(out)] * to_v;
    });
    refined_.collapse(along);
    patch_[v] = -1;
    return true;
  }

  void run() {
    const int first = refined_.original().mesh.vertex_count();
    for (int pass = 0; pass < kPasses; ++pass) {
      bool any = false;
      for (int v = first; v < refined_.vertex_count(); ++v)
        if (patch_[v] >= 0 && corner_[v] < 0) any |= take_out(v);
      if (!any) return;
    }
  }

  RefinedMap finish() {
    RefinedSurface::Compact compact = refined_.compact();
    Atlas& atlas = map_.atlas;
    atlas.surface = std::make_shared<const Surface>(std::move(compact.mesh));
    const int count = atlas.surface->mesh.vertex_count();
    atlas.patch.assign(count, -1);
    atlas.position.assign(count, 0.0);
    atlas.corner.assign(count, -1);
    for (int v = 0; v < refined_.vertex_count(); ++v) {
      if (compact.vertex[v] < 0) continue;
      atlas.patch[compact.vertex[v]] = patch_[v];
      atlas.position[compact.vertex[v]] = position_[v];
      if (corner_[v] < 0) continue;
      atlas.corner[compact.vertex[v]] = corner_[v];
      atlas.base.vertices[corner_[v]] = compact.vertex[v];
    }
    atlas.transition.clear();
    for (int h : atlas.surface->edge_halfedge) atlas.transition.push_back(transition_[compact.halfedge[h]]);
    map_.vertex = std::move(compact.vertex);
    map_.halfedge = std::move(compact.halfedge);
    return std::move(map_);
  }

 private:
  RefinedMap map_;
  RefinedSurface& refined_;
  std::vector<int> patch_;              ///< per vertex, -1 for those that are out
  std::vector<int> corner_;             ///< per vertex, its base vertex or -1
  std::vector<Complex> position_;       ///< per vertex
  std::vector<Transition> transition_;  ///< per half-edge, from the chart of its head to that of its tail
};

}  // namespace

RefinedMap coarsen(RefinedMap map) {
  Coarsener coarsener(std::move(map));
  coarsener.run();
  return coarsener.finish();
}

}  // namespace gsp
