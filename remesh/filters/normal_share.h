#pragma once

#include "remesh/semiregular.h"

namespace gsp {

/// How many of a mesh's vertices above its base take one number to give.
struct NormalShare {
  int vertices = 0;    ///< above the base
  int boundary = 0;    ///< of these on the boundary, whatever their details
  int creased = 0;     ///< and on creases
  int normal = 0;      ///< of the others: no tangential part
  int exceptions = 0;  ///< the rest

  /// Of the vertices that are on neither, in percent; 100 where there are none.
  double percent() const { return normal + exceptions > 0 ? 100.0 * normal / (normal + exceptions) : 100.0; }
};

/// Each level against what Butterfly predicts from the coarser one, in the frames that a decoder has (local_frames.h).
/// A tangential part under 1e-9 of the mesh's extent is rounding: a code of so many bits has none. O(vertices).
NormalShare normal_share(const SemiregularMesh& mesh);

}  // namespace gsp
