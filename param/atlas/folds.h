#pragma once

#include <vector>

#include "param/atlas/atlas.h"

namespace gsp {

/// Where a map is not locally injective.
struct Folds {
  std::vector<int> faces;  ///< no positive area in their chart (above rounding)
  /// Wound wrongly: the angles of the faces around it do not sum to 2π, valence·60° at a corner, π on a boundary. A
  /// corner of valence 7 or more can lose a full turn to a neighbour with no face folded, which areas alone cannot see.
  std::vector<int> vertices;

  bool none() const { return faces.empty() && vertices.empty(); }
};

/// O(F). Vertices of folded faces are not listed again under `vertices`.
Folds find_folds(const Atlas& atlas);

/// The vertices within so many edges of the folds, nearest first, and per vertex of the surface how many; -1 beyond.
struct FoldRings {
  std::vector<int> vertices;
  std::vector<int> distance;
};
FoldRings rings_around(const Surface& surface, const Folds& folds, int most);

/// How the faces around one vertex lie.
enum class LocalMap {
  Injective,  ///< all upright, and round the vertex exactly as often as they should
  Folded,     ///< some not upright
  Miswound    ///< all upright, but round the vertex once too often or too rarely
};
LocalMap local_map(const Atlas& atlas, int vertex);

/// Whether a chart triangle has positive area, clear of rounding.
bool upright(Complex a, Complex b, Complex c);

}  // namespace gsp
