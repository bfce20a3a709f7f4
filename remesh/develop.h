#pragma once

#include <vector>

#include "param/map/parameterization.h"

namespace gsp {

/// A face as a chart sees it: `motion` takes the face's corners from its own chart into that of base face `chart`.
struct FacePiece {
  int chart = 0;
  int face = 0;
  Transition motion;
};

/// Appends a piece for each base face that face `face` reaches, first the one that holds its centroid.
void develop_face(const Parameterization& map, int face, std::vector<FacePiece>& pieces);

/// Appends the same for any triangle, which the pieces call `face`: `corners` in the chart of base face `chart`, in
/// whose triangle `start` lies, a point of the corners' triangle.
///
/// The triangle is unfolded over the base by flooding: it enters a neighbour where it crosses the common edge. No base
/// corner lies inside a face of a valid map and the face is convex, so what it covers of a base triangle is connected
/// through the edge it entered by: beside a corner of any valence each point is found in the right sector, without
/// walking to it. On a map with folds the flood ends after `kMaxPieces`. Cost: the number of pieces.
void develop_triangle(const BaseComplex& base, int face, int chart, Complex start,
                      const std::array<Complex, 3>& corners, std::vector<FacePiece>& pieces);

/// The pieces of all faces, by chart and within one by face.
std::vector<std::vector<FacePiece>> pieces_by_chart(const Parameterization& map);

inline constexpr int kMaxPieces = 256;

}  // namespace gsp
