#pragma once

#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {

/// A surface cut open along some of its edges.
struct CutMesh {
  Mesh mesh;                  ///< faces in their order; vertices keep their numbers, further copies of them come last
  std::vector<int> original;  ///< #V the vertex of the whole surface that it is a copy of, or itself
};

struct CutCounts {
  int edges = 0;           ///< that were cut
  int vertices = 0;        ///< that became more than one, those at the ends of cut edges among them
  int added_vertices = 0;  ///< copies
};

/// A surface cut apart where it is no consistently oriented manifold.
struct CutApart {
  CutMesh surface;
  CutCounts counts;
};

/// Cuts apart edges of more than two faces, or of two that run the same way, and vertices of more than one fan, by the
/// cutting and stitching of Guéziec, Taubin, Lazarus and Horn 2001. All faces at such an edge come apart along it. Then
/// two of them meet again where the other edges, and those that met again before, hold them in one fan at an end of the
/// edge: a cut that ends inside a sheet heals from its end. So solids that share edges part without a boundary, and a
/// fin comes off a surface that stays whole, while sheets that meet all along a curve, as the pages of a book, each end
/// there. The rule takes no angles, which rounding could turn, and every pair agrees in orientation: the two ends of a
/// fan run opposite ways. Every fan becomes a vertex; the one of the smallest face keeps the number. Points and area
/// stay the same, and a manifold stays as it is. Faces that name a vertex twice are left alone. O(V + F log F).
/// Throws Error(IndexOutOfRange).
CutApart cut_apart(const Mesh& mesh);

}  // namespace gsp
