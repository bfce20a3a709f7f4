#include "param/removal/edge_paths.h"

#include <algorithm>

namespace gsp {

EdgePaths::EdgePaths(int edges, int triangles)
    : list_of_(edges, -1), crossing_(triangles), star_index_(triangles, -1), seen_(edges, 0) {}

const std::vector<int>& EdgePaths::path(int edge) const {
  static const std::vector<int> none;
  return list_of_[edge] < 0 ? none : lists_[list_of_[edge]];
}

void EdgePaths::begin(const Surface& surface, const Star& star, const std::vector<std::vector<int>>& points) {
  affected_.clear();
  for (std::size_t k = 0; k < star.triangles.size(); ++k) star_index_[star.triangles[k]] = static_cast<int>(k);
  const auto take = [&](int edge) {
    if (seen_[edge]) return;
    seen_[edge] = 1;
    affected_.push_back({edge, path(edge)});
  };
  for (int t : star.triangles) {
    for (int edge : crossing_[t]) {
      const std::vector<int>& list = path(edge);
      if (std::find(list.begin(), list.end(), t) != list.end()) take(edge);
    }
    crossing_[t].clear();
  }
  const auto take_around = [&](int vertex) {
    surface.for_each_neighbour(vertex, [&](int, int edge, bool) {
      if (list_of_[edge] < 0) take(edge);
    });
  };
  take_around(star.center);
  for (int t : star.triangles)
    for (int vertex : points[t]) take_around(vertex);
}

int EdgePaths::start_slot(const TriangleComplex& complex, int vertex, const std::vector<Location>& locations) const {
  if (locations[vertex].triangle >= 0) return locations[vertex].triangle;
  for (int slot : slots_)
    if (complex.corner_index(slot, vertex) >= 0) return slot;
  return -1;
}

void EdgePaths::append_tree_path(int from, int to, std::vector<int>& path) const {
  const auto index = [&](int slot) {
    return static_cast<int>(std::find(slots_.begin(), slots_.end(), slot) - slots_.begin());
  };
  int a = index(from), b = index(to);
  std::vector<int> tail;
  while (a != b) {
    if (depth_[a] >= depth_[b]) {
      path.push_back(slots_[a]);
      a = parent_[a];
    } else {
      tail.push_back(slots_[b]);
      b = parent_[b];
    }
  }
  path.push_back(slots_[a]);
  path.insert(path.end(), tail.rbegin(), tail.rend());
}

void EdgePaths::rebuild(const Surface& surface, const TriangleComplex& complex, const Affected& affected,
                        const std::vector<Location>& locations, std::vector<int>& path) const {
  path.clear();
  const int h = surface.edge_halfedge[affected.edge];
  const int start = surface.halfedges.from(h), end = surface.halfedges.to(h);
  const std::vector<int>& old = affected.path;
  if (old.empty()) {
    append_tree_path(start_slot(complex, start, locations), start_slot(complex, end, locations), path);
  }
  for (std::size_t i = 0; i < old.size();) {
    if (star_index_[old[i]] < 0) {
      path.push_back(old[i++]);
      continue;
    }
    std::size_t last = i;
    while (last + 1 < old.size() && star_index_[old[last + 1]] >= 0) ++last;
    const int entry = i == 0 ? start_slot(complex, start, locations) : slot_at_ring_edge(star_index_[old[i]]);
    const int exit =
        last + 1 == old.size() ? start_slot(complex, end, locations) : slot_at_ring_edge(star_index_[old[last]]);
    append_tree_path(entry, exit, path);
    i = last + 1;
  }
  // Cancel back-tracks.
  std::size_t size = 0;
  for (int t : path) {
    if (size >= 2 && path[size - 2] == t)
      --size;
    else if (size == 0 || path[size - 1] != t)
      path[size++] = t;
  }
  path.resize(size);
  // Trim turns about a corner at either end.
  std::size_t first = 0;
  if (locations[start].triangle < 0)
    while (first + 1 < path.size() && complex.corner_index(path[first + 1], start) >= 0) ++first;
  path.erase(path.begin(), path.begin() + first);
  if (locations[end].triangle < 0)
    while (path.size() > 1 && complex.corner_index(path[path.size() - 2], end) >= 0) path.pop_back();
}

/// False where nothing is kept.
bool EdgePaths::keep(int edge, const std::vector<int>& path) {
  if (path.size() <= 1) {
    if (list_of_[edge] >= 0) {
      lists_[list_of_[edge]].clear();
      free_lists_.push_back(list_of_[edge]);
      list_of_[edge] = -1;
    }
    return false;
  }
  if (list_of_[edge] < 0) {
    if (free_lists_.empty()) {
      free_lists_.push_back(static_cast<int>(lists_.size()));
      lists_.emplace_back();
    }
    list_of_[edge] = free_lists_.back();
    free_lists_.pop_back();
  }
  lists_[list_of_[edge]] = path;
  return true;
}

void EdgePaths::finish(const Surface& surface, const TriangleComplex& complex, const Star& star,
                       const std::vector<RingTriangle>& triangles, const std::vector<int>& slots,
                       const std::vector<Location>& locations) {
  slots_ = slots;
  const int n = star.size();
  slot_of_ring_edge_.assign(n, -1);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if ((triangles[i][k] + 1) % n == triangles[i][(k + 1) % 3]) slot_of_ring_edge_[triangles[i][k]] = slots[i];
  // Root the dual tree at the first triangle.
  parent_.assign(slots.size(), -1);
  depth_.assign(slots.size(), -1);
  depth_[0] = 0;
  std::vector<int> order{0};
  for (std::size_t i = 0; i < order.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto at = std::find(slots.begin(), slots.end(), complex.neighbour(slots[order[i]], k));
      if (at == slots.end()) continue;
      const int next = static_cast<int>(at - slots.begin());
      if (depth_[next] >= 0) continue;
      depth_[next] = depth_[order[i]] + 1;
      parent_[next] = order[i];
      order.push_back(next);
    }
  std::vector<int> path;
  for (const Affected& affected : affected_) {
    rebuild(surface, complex, affected, locations, path);
    if (keep(affected.edge, path))
      for (int t : path)
        if (std::find(slots_.begin(), slots_.end(), t) != slots_.end()) crossing_[t].push_back(affected.edge);
    seen_[affected.edge] = 0;
  }
  for (int t : star.triangles) star_index_[t] = -1;
}

}  // namespace gsp
