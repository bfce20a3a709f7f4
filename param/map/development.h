#pragma once

#include <unordered_map>
#include <vector>

#include "param/map/parameterization.h"

namespace gsp {

/// A face as a chart sees it: `motion` takes the face's corners from its own chart into that of base face `chart`.
struct FacePiece {
  int chart = 0;
  int face = 0;
  Transition motion;
};

inline constexpr int kMaxPieces = 256;

/// Appends a piece for each base face that a triangle reaches, which the pieces call `face`, first the one that holds
/// its centroid. `corners` are in the chart of base face `chart`, in whose triangle `start` lies, a point of the
/// corners' triangle and no base vertex, or one in the chart's sector. As `Development::append` does for faces of a
/// map.
void develop_triangle(const BaseComplex& base, int face, int chart, Complex start,
                      const std::array<Complex, 3>& corners, std::vector<FacePiece>& pieces);

/// The pieces of all faces of a map, by chart and within one by face. O(pieces), on all threads, the same on any
/// number of them.
std::vector<std::vector<FacePiece>> pieces_by_chart(const Parameterization& map);

/// The faces of a map laid out over the base faces that they reach. `map` must outlive it.
class Development {
 public:
  /// O(faces).
  explicit Development(const Parameterization& map);

  /// Appends a piece for each base face that face `face` reaches, first the one that holds its centroid.
  ///
  /// The face is unfolded over the base by flooding: it enters a neighbour where it crosses the common edge. No base
  /// corner lies inside a face of a valid map and the face is convex, so what it covers of a base triangle is connected
  /// through the edge it entered by: beside a corner of any valence each point is found in the right sector, without
  /// walking to it. On a map with folds the flood ends after `kMaxPieces`. Cost: the number of pieces.
  void append(int face, std::vector<FacePiece>& pieces) const;

 private:
  void place_beside_others(std::vector<int> faces);

  const Parameterization& map_;
  /// The piece that holds the centroid, of faces that lie outside of their chart with all corners, as between patch
  /// corners. The chart alone does not tell in which sector about a corner such a face lies; the face beside it does.
  std::unordered_map<int, FacePiece> centre_;
};

}  // namespace gsp
