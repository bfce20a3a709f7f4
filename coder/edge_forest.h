#pragma once

#include <array>
#include <vector>

#include "mesh/export.h"
#include "remesh/semiregular.h"

namespace GSP_PUBLIC gsp {

/// The trees of edges over which details are coded (algorithms.md §6; Khodakovsky, Schröder, Sweldens 2000). A node is
/// the detail of one edge; nodes are numbered level by level in edge order, roots (the base edges) first. The children
/// of an edge are its two halves and the parallel edge inside each of its triangles.
struct EdgeForest {
  static constexpr int kNone = -1;

  std::vector<int> level_begin;                ///< #levels + 1, first node of each level
  std::vector<int> parent;                     ///< #N, kNone for roots
  std::vector<std::array<int, 4>> children;    ///< #N, kNone after the last, and at the finest level
  std::vector<std::array<int, 4>> neighbours;  ///< #N, the other sides of the edge's triangles, kNone on a boundary

  std::vector<char> creased;  ///< #N, whether the edge is a crease or a part of one

  /// `levels`: those whose edges carry details.
  explicit EdgeForest(const std::vector<SubdivisionLevel>& levels);

  /// On a boundary or crease, whose points have three components in every kind of stream.
  bool on_curve(int node) const { return neighbours[node][2] == kNone || creased[node]; }
  int levels() const { return static_cast<int>(level_begin.size()) - 1; }
  int nodes() const { return static_cast<int>(parent.size()); }
};

}  // namespace gsp
