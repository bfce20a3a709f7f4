#pragma once

#include <memory>
#include <vector>

#include "mesh/halfedges.h"
#include "mesh/mesh.h"

namespace gsp {

/// The surface that is parameterized with its connectivity, shared unchanged by all maps onto one base complex.
struct Surface {
  Mesh mesh;
  Halfedges halfedges;
  std::vector<int> edge_of;         ///< #3F half-edge -> edge
  std::vector<int> edge_halfedge;   ///< #E, the edge's half-edge of smaller index: it gives the edge its direction
  std::vector<double> vertex_area;  ///< #V area of the Voronoi region (mixed for obtuse faces, Meyer et al. 2003)
  std::vector<double> face_area;    ///< #F
  std::vector<int> fan_size;        ///< #V faces around the vertex

  explicit Surface(Mesh input);
  /// One that stands for a finer surface: each face for a part of it of the given area, not its own.
  Surface(Mesh input, std::vector<double> areas);
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  int edge_count() const { return static_cast<int>(edge_halfedge.size()); }

  /// Calls visit(neighbour, edge, forward) for every edge at v; forward is true where the edge's direction leaves v.
  template <class Visit>
  void for_each_neighbour(int v, Visit&& visit) const {
    const int start = halfedges.outgoing[v];
    for (int h = start; h >= 0;) {
      visit(halfedges.to(h), edge_of[h], edge_halfedge[edge_of[h]] == h);
      const int in = Halfedges::prev(h);
      if (halfedges.twin[in] < 0) {
        visit(halfedges.from(in), edge_of[in], false);
        return;
      }
      h = halfedges.twin[in];
      if (h == start) return;
    }
  }
};

/// The faces at some vertices, ascending. O(n log n) of their number.
std::vector<int> faces_around(const Surface& surface, const std::vector<int>& vertices);

/// The vertices of some faces, ascending. O(n log n) of their number.
std::vector<int> vertices_of(const std::vector<Triangle>& faces, const std::vector<int>& some);

}  // namespace gsp
