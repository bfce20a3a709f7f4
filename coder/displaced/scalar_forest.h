#pragma once

#include <array>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// The trees over which displacements are coded: those of edges (coder/edge_forest.h) and, in front of them, the base
/// vertices, which stand alone. Node v < #V is the coefficient of vertex v along the normals. Then come the vertices of
/// the boundary, by their number, for the coefficients across it.
struct ScalarForest {
  static constexpr int kNone = -1;

  /// Nodes of one level and one direction; level 0 is the base's vertices, level l + 1 the edges of level l.
  struct Group {
    int level;
    bool across;
    int begin, end;
  };

  int vertices = 0;
  std::vector<Group> groups;                   ///< by level, along before across
  std::vector<int> vertex;                     ///< #N
  std::vector<int> parent;                     ///< #N, kNone for base vertices and base edges
  std::vector<std::array<int, 4>> children;    ///< #N, kNone after the last
  std::vector<std::array<int, 4>> neighbours;  ///< #N, of the same group, kNone where there is none
  std::vector<std::array<int, 2>> ends;        ///< #N, of an edge's node those of its two ends, else kNone

  /// `levels`: from the base to the finest whose vertices are coded.
  explicit ScalarForest(const std::vector<SubdivisionLevel>& levels);

  int nodes() const { return static_cast<int>(vertex.size()); }
  int levels() const { return groups.empty() ? 0 : groups.back().level + 1; }
};

}  // namespace gsp
