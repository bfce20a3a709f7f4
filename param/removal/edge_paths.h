#pragma once

#include <vector>

#include "param/removal/removal_cost.h"
#include "param/removal/triangle_complex.h"

namespace gsp {

/// The ordered triangles of the complex that each edge of the surface crosses (§3.1.2, "transition lists"). No geometry
/// is involved: a filled hole is a triangulated polygon whose dual graph is a tree, so the part of an edge inside it is
/// the unique tree path between its entry and its exit; back-tracks are cancelled and turns about a corner at either
/// end are trimmed. Only edges that are not wholly inside one triangle hold a list: an edge without one runs in the
/// triangle of whichever end is not a corner, or, between two corners, along an edge of the complex.
class EdgePaths {
 public:
  EdgePaths(int edges, int triangles);

  /// Where a removal stands: call `begin` before the complex changes and `finish` after vertices were relocated.
  void begin(const Surface& surface, const Star& star, const std::vector<std::vector<int>>& points);
  void finish(const Surface& surface, const TriangleComplex& complex, const Star& star,
              const std::vector<RingTriangle>& triangles, const std::vector<int>& slots,
              const std::vector<Location>& locations);

  /// The list of an edge from its start (`edge_halfedge`'s tail) to its end; empty where it holds none.
  const std::vector<int>& path(int edge) const;

 private:
  struct Affected {
    int edge;
    std::vector<int> path;  ///< before the removal; empty for an edge without a list
  };

  int slot_at_ring_edge(int ring_edge) const { return slot_of_ring_edge_[ring_edge]; }
  int start_slot(const TriangleComplex& complex, int vertex, const std::vector<Location>& locations) const;
  void append_tree_path(int from, int to, std::vector<int>& path) const;
  void rebuild(const Surface& surface, const TriangleComplex& complex, const Affected& affected,
               const std::vector<Location>& locations, std::vector<int>& path) const;
  bool keep(int edge, const std::vector<int>& path);

  std::vector<int> list_of_;  ///< #E index into lists_, -1 without a list
  std::vector<std::vector<int>> lists_;
  std::vector<int> free_lists_;
  std::vector<std::vector<int>> crossing_;  ///< per triangle, edges whose list has it (may hold stale ones)

  std::vector<int> star_index_;  ///< per triangle slot, its index in the star or -1
  std::vector<Affected> affected_;
  std::vector<char> seen_;  ///< per edge, while affected_ is collected
  std::vector<int> slots_;
  std::vector<int> slot_of_ring_edge_;
  std::vector<int> parent_, depth_;  ///< dual tree over slots_, by index
};

}  // namespace gsp
