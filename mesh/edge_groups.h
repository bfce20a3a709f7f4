#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

inline bool names_vertex_twice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// A half-edge has the number of the corner where it starts.
inline int next_corner(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline int previous_corner(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
inline int vertex_at(const Mesh& mesh, int corner) { return mesh.faces[corner / 3][corner % 3]; }

/// The half-edges of any triangle soup grouped by their undirected edge. Half-edge 3f + k runs from corner k to corner
/// k+1 of face f, as in `Halfedges`. Faces that name a vertex twice are left out. O(V + F log F).
class EdgeGroups {
 public:
  explicit EdgeGroups(const Mesh& mesh);

  int size() const { return static_cast<int>(starts_.size()) - 1; }
  /// The half-edges of one edge, ascending; edges are in order of their smaller, then their larger vertex.
  std::span<const int> operator[](int edge) const {
    return std::span<const int>(halfedges_).subspan(starts_[edge], starts_[edge + 1] - starts_[edge]);
  }

 private:
  std::vector<int> halfedges_;
  std::vector<int> starts_;
};

}  // namespace gsp
