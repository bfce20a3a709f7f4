#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Half-edge connectivity of a manifold, consistently oriented mesh over its own faces, without copies of them:
/// half-edge 3f + k runs from corner k to corner k+1 of face f. `twin` is -1 on a boundary. O(F) memory, O(F log F) to
/// build. Undefined on non-manifold input: call `require_parameterizable` first.
struct Halfedges {
  std::vector<int> twin;            ///< #3F; -1 where the edge has one face
  std::vector<int> outgoing;        ///< #V; a half-edge that leaves the vertex, on a boundary vertex the one without a
                                    ///< twin, whose face comes first counter-clockwise; -1 for isolated vertices
  const Triangle* faces = nullptr;  ///< of the mesh, which must stay where it is

  explicit Halfedges(const Mesh& mesh);

  static int face(int h) { return h / 3; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int prev(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  int from(int h) const { return faces[h / 3][h % 3]; }
  int to(int h) const { return from(next(h)); }
  bool boundary_vertex(int v) const;
  /// The next outgoing half-edge of the same vertex counter-clockwise, -1 past the last face of a boundary vertex.
  int rotate_ccw(int h) const { return twin[prev(h)]; }
};

}  // namespace gsp
