#include "param/atlas/mend_charts.h"

#include <algorithm>
#include <optional>

#include "mesh/disjoint_sets.h"
#include "param/map/lattice_motion.h"

namespace gsp {

namespace {

class ChartMender {
 public:
  explicit ChartMender(Atlas& atlas) : atlas_(atlas), surface_(*atlas.surface), groups_(atlas.patch.size()) {}
  int run();

 private:
  /// How a vertex sees another one: the change from the other's chart into its own, and a point of its own chart that
  /// the way leads by, where that is not straight.
  struct View {
    int other;
    Transition change;
    std::optional<Complex> by;
  };

  bool tells(int v) const { return atlas_.patch[v] >= 0 && atlas_.corner[v] < 0; }
  template <class Visit>
  void for_each_view(int v, Visit&& visit) const;
  std::optional<View> view_over(int h) const;
  std::optional<Arrival> walk(int v, const View& view) const;
  bool agrees(int v, const Arrival& seen) const;

  void find_groups();
  void grow_from(int group);

  Atlas& atlas_;
  const Surface& surface_;
  DisjointSets groups_;  ///< of the vertices
  /// Neighbours that do not agree.
  std::vector<std::array<int, 2>> torn_;
  std::vector<char> right_;    ///< #V, whether it follows a group, or is where one touches another
  std::vector<char> settled_;  ///< #V, at the root of a group: whether others have followed it
  int mended_ = 0;
};

/// What the vertex opposite to a half-edge sees over it. Nothing but over an edge between patch corners, to a vertex
/// that is none.
std::optional<ChartMender::View> ChartMender::view_over(int h) const {
  const Halfedges& links = surface_.halfedges;
  const int twin = links.twin[h];
  if (twin < 0 || atlas_.corner[links.from(h)] < 0 || atlas_.corner[links.to(h)] < 0) return std::nullopt;
  const int other = links.from(Halfedges::prev(twin));
  if (!tells(other)) return std::nullopt;
  const auto end = [&](int face, int k) {
    return atlas_.face_frame(face).to_chart[k].apply(atlas_.position[surface_.mesh.faces[face][k]]);
  };
  const Complex a = end(h / 3, h % 3), b = end(h / 3, Halfedges::next(h) % 3);
  const auto change = lattice_motion(end(twin / 3, Halfedges::next(twin) % 3), end(twin / 3, twin % 3), a, b);
  if (!change) return std::nullopt;
  return View{other, *change, 0.5 * (a + b)};
}

template <class Visit>
void ChartMender::for_each_view(int v, Visit&& visit) const {
  bool beside_corners = false;
  surface_.for_each_neighbour(v, [&](int w, int edge, bool forward) {
    beside_corners |= atlas_.corner[w] >= 0;
    if (tells(w)) visit(View{w, atlas_.towards(edge, forward), std::nullopt});
  });
  if (!beside_corners) return;
  const int first = surface_.halfedges.outgoing[v];
  for (int h = first; h >= 0;) {
    const auto view = view_over(Halfedges::next(h));
    if (view) visit(*view);
    h = surface_.halfedges.rotate_ccw(h);
    if (h == first) return;
  }
}

/// Where a vertex sees another one, and the change from the other's chart to that place.
std::optional<Arrival> ChartMender::walk(int v, const View& view) const {
  Arrival at{atlas_.patch[v], {}};
  Complex from = atlas_.position[v];
  if (view.by) {
    const auto half = follow(atlas_.base, at.chart, from, *view.by);
    if (!half) return std::nullopt;
    at = *half;
    from = at.change.apply(*view.by);
  }
  const Transition change = at.change * view.change;
  const auto end = follow(atlas_.base, at.chart, from, change.apply(atlas_.position[view.other]));
  if (!end) return std::nullopt;
  return Arrival{end->chart, end->change * change};
}

/// Whether the place is that of the vertex: the same one in the same chart, or on the edge between two.
bool ChartMender::agrees(int v, const Arrival& seen) const {
  if (seen.chart == atlas_.patch[v]) return seen.change.is_identity();
  const BaseComplex& base = atlas_.base;
  for (int h = 3 * seen.chart; h < 3 * seen.chart + 3; ++h)
    if (base.twins[h] >= 0 && base.twins[h] / 3 == atlas_.patch[v] && (base.across(h) * seen.change).is_identity())
      return true;
  return false;
}

void ChartMender::find_groups() {
  for (int v = 0; v < static_cast<int>(atlas_.patch.size()); ++v) {
    if (!tells(v) || !inside_chart(atlas_.position[v])) continue;
    for_each_view(v, [&](const View& view) {
      if (view.other < v || !inside_chart(atlas_.position[view.other])) return;
      const auto seen = walk(v, view);
      if (!seen) return;
      if (agrees(view.other, *seen))
        groups_.unite(v, view.other);
      else
        torn_.push_back({v, view.other});
    });
  }
}

/// Carries the places of a group to all that see one of it.
void ChartMender::grow_from(int group) {
  settled_[group] = 1;
  std::vector<int> rim;
  for (const auto& pair : torn_)
    for (int v : pair)
      if (groups_.root(v) == group && !right_[v]) {
        right_[v] = 1;
        rim.push_back(v);
      }
  for (std::size_t i = 0; i < rim.size(); ++i)
    for_each_view(rim[i], [&](const View& view) {
      const int w = view.other;
      if (right_[w] || settled_[groups_.root(w)] || !inside_chart(atlas_.position[w])) return;
      const auto seen = walk(rim[i], view);
      if (!seen) return;
      if (!agrees(w, *seen)) {
        atlas_.change_chart(w, seen->chart, seen->change);
        ++mended_;
      }
      right_[w] = 1;
      rim.push_back(w);
    });
}

int ChartMender::run() {
  find_groups();
  if (torn_.empty()) return 0;
  std::vector<int> size(atlas_.patch.size(), 0), groups;
  for (int v = 0; v < static_cast<int>(size.size()); ++v) ++size[groups_.root(v)];
  for (const auto& pair : torn_)
    for (int v : pair) groups.push_back(groups_.root(v));
  std::sort(groups.begin(), groups.end(), [&](int a, int b) { return size[a] != size[b] ? size[a] > size[b] : a < b; });
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  right_.assign(size.size(), 0);
  settled_.assign(size.size(), 0);
  for (int group : groups) grow_from(group);
  return mended_;
}

}  // namespace

int mend_charts(Atlas& atlas) { return ChartMender(atlas).run(); }

}  // namespace gsp
