#pragma once

#include <array>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "param/map/lattice.h"

namespace GSP_PUBLIC gsp {

/// The abstract parameter domain: base triangles, each an equilateral chart with corners 0, 1, ω, glued along edges.
struct BaseComplex {
  std::vector<int> vertices;    ///< #B, for each base vertex its vertex in the surface
  std::vector<Triangle> faces;  ///< #P, indices into `vertices`, oriented like the surface
  std::vector<int> twins;       ///< #3P, half-edge 3f + k (corner k to k+1) -> its twin, -1 on a boundary
  /// #C, interior base edges on feature curves of the surface, each as its two base vertices a < b, ascending. The map
  /// is continuous across them, but smooth along them only. Empty for a surface without features.
  std::vector<std::array<int, 2>> creases;

  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }

  /// Fills `twins` from `faces`. Call once after the faces are set.
  void connect();

  /// The change of chart across half-edge h of face h / 3, from that face's chart into the chart of the neighbour.
  /// h must have a twin. Both charts have their corners at 0, 1 and ω; the motion ω^k z + t lays one beside the other:
  ///
  ///      the face's chart, h = 3f + 1          the neighbour's, twin = 3g + 0
  ///
  ///             2 (ω)                                 2 (ω)
  ///             / \                                   / \          corner 1 of f -> corner 1 of g
  ///            / f \ h     ---- across(h) --->       / g \         corner 2 of f -> corner 0 of g
  ///           /     \                               /     \        the rest of f -> below the edge
  ///       0 (0) --- 1 (1)                       0 (0) -h- 1 (1)
  ///
  Transition across(int h) const;

  /// #3P, whether a half-edge lies on a crease. O(P log C).
  std::vector<char> crease_halfedges() const;
};

}  // namespace gsp
