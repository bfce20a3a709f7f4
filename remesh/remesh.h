#pragma once

#include "mesh/progress.h"
#include "param/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp {

struct RemeshOptions {
  /// Quadrisections of the base, 0..kMaxSubdivisionLevel, or kAutoLevel: the first level with at least as many faces as the
  /// surface, or the deepest one.
  int level = kAutoLevel;
  static constexpr int kAutoLevel = 99;
};

/// Quadrisects the base and maps every dyadic point through the parameterization to the surface (paper §4).
/// Points on base vertices are the surface's own vertices, bit for bit. For a map that `check_map` finds valid every point
/// is the exact inverse. Where a baseline's map folds, faces of positive area are preferred to flipped ones; a point in no
/// face takes the nearest place in a face beside it, and `progress` notes how many there were.
/// O(faces + samples), on all threads, the same bits for any number of them.
/// Throws Error: BadOption, InvalidMap where nothing covers a base face, the errors of `require_well_formed`.
SemiregularMesh remesh(const Parameterization& map, const RemeshOptions& options, Progress& progress);

}  // namespace gsp
