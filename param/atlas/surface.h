#pragma once

#include <memory>
#include <vector>

#include "mesh/halfedges.h"
#include "mesh/mesh.h"

namespace gsp {

/// Where a surface was cut open along feature curves: which of its vertices are copies of one. Vertices beyond the
/// vectors' ends are on no curve.
struct Seams {
  std::vector<int> point;  ///< #V a number that the copies of one vertex on a curve share, -1 off the curves
  /// #V inside a curve the other copy; -1 for the corners of curves, which stay in the base, and off the curves.
  std::vector<int> other;
  int points = 0;  ///< numbers in `point` are below this

  bool any() const { return points > 0; }
  int point_of(int v) const { return v < static_cast<int>(point.size()) ? point[v] : -1; }
  int other_of(int v) const { return v < static_cast<int>(other.size()) ? other[v] : -1; }
  bool is_corner(int v) const { return point_of(v) >= 0 && other_of(v) < 0; }
  /// Whether two vertices are one on the whole surface.
  bool same(int a, int b) const { return a == b || (point_of(a) >= 0 && point_of(a) == point_of(b)); }
  /// Those of some of the vertices, which get the numbers 0, 1, ... in their order; all copies of one are among them.
  Seams of(const std::vector<int>& vertices) const;
  /// How many vertices of the whole surface some are.
  int count_whole(const std::vector<int>& vertices) const;
};

/// The surface that is parameterized with its connectivity, shared unchanged by all maps onto one base complex.
struct Surface {
  Mesh mesh;
  Halfedges halfedges;
  std::vector<int> edge_of;         ///< #3F half-edge -> edge
  std::vector<int> edge_halfedge;   ///< #E, the edge's half-edge of smaller index: it gives the edge its direction
  std::vector<double> vertex_area;  ///< #V area of the Voronoi region (mixed for obtuse faces, Meyer et al. 2003)
  std::vector<double> face_area;    ///< #F
  std::vector<int> fan_size;        ///< #V faces around the vertex
  Seams seams;                      ///< none unless the surface was cut open

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
