#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Splits every interior edge whose two ends lie on the boundary at its middle. Without this a face whose corners lie
/// on one straight boundary edge of the base would have no area. New vertices come last; each split face is replaced in
/// place, the further pieces come last. Returns for each new vertex the two that it lies between.
std::vector<std::array<int, 2>> split_boundary_chords(Mesh& mesh);

/// What `split_long_edges` did.
struct LongEdgeSplit {
  std::vector<std::array<int, 2>> ends;  ///< of each vertex added, the two that it lies between
  int added() const { return static_cast<int>(ends.size()); }
  double longest = 0.0;  ///< length to which edges were split: what was asked for, or more where that took too many
};

/// Splits edges longer than `longest` > 0 at their middles until there is none, with at most `most` >= 0 new vertices:
/// where those are too few, the length is raised by steps of √2 until they suffice. Numbering as above. O(F + most) a
/// step, and two steps for each doubling of the longest edge over `longest`.
LongEdgeSplit split_long_edges(Mesh& mesh, double longest, int most);

}  // namespace gsp
