#pragma once

#include "coder/edge_forest.h"

namespace gsp {

/// The nodes of a scalar field: base vertices first, which stand alone, then those of the edge forest.
struct ScalarForest {
  static constexpr int kNone = EdgeForest::kNone;

  std::vector<int> level_begin;                ///< base vertices, edges of level 0, ..., end
  std::vector<int> parent;                     ///< kNone for base vertices and base edges
  std::vector<std::array<int, 4>> children;    ///< kNone after the last
  std::vector<std::array<int, 4>> neighbours;  ///< kNone where there is none
  std::vector<std::array<int, 2>> ends;        ///< nodes of the two vertices an edge's vertex lies between

  explicit ScalarForest(const std::vector<SubdivisionLevel>& levels);
  int levels() const { return static_cast<int>(level_begin.size()) - 1; }
  int nodes() const { return static_cast<int>(parent.size()); }
};

}  // namespace gsp
