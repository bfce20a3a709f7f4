#pragma once

#include "mesh/progress.h"
#include "param/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp {

struct RemeshOptions {
  /// Quadrisections of the base, 0..10, or kAutoLevel: the first level with at least as many faces as the surface.
  int level = kAutoLevel;
  static constexpr int kAutoLevel = 99;
};

/// Quadrisects the base and maps every dyadic point through the parameterization to the surface (paper §4).
/// O(faces + samples). Points on base vertices are the surface's own vertices, bit for bit.
/// Throws Error: BadOption, InvalidMap where a point lies in no face.
SemiregularMesh remesh(const Parameterization& map, const RemeshOptions& options, Progress& progress);

}  // namespace gsp
