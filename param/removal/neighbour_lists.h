#pragma once

#include <span>
#include <vector>

#include "param/atlas/surface.h"

namespace gsp {

/// The neighbours of every vertex of a surface side by side, in the order of `Surface::for_each_neighbour`: for walks
/// that ask for nothing else, and so often that going from half-edge to half-edge takes most of their time. O(V + F).
class NeighbourLists {
 public:
  explicit NeighbourLists(const Surface& surface) {
    first_.reserve(surface.mesh.positions.size() + 1);
    vertices_.reserve(surface.halfedges.twin.size());
    for (int v = 0; v < surface.mesh.vertex_count(); ++v) {
      surface.for_each_neighbour(v, [&](int w, int, bool) { vertices_.push_back(w); });
      first_.push_back(static_cast<int>(vertices_.size()));
    }
  }

  std::span<const int> operator[](int v) const {
    return std::span<const int>(vertices_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

 private:
  std::vector<int> first_{0}, vertices_;
};

}  // namespace gsp
