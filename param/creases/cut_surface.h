#pragma once

#include <memory>
#include <vector>

#include "mesh/features/features.h"
#include "param/atlas/surface.h"

namespace gsp {

/// A surface cut open along its feature curves, which so become boundaries, along which a map is made like along any
/// other.
struct CutSurface {
  std::shared_ptr<const Surface> surface;  ///< with seams
  int whole_vertices = 0;                  ///< of the surface before; the copies of some come next
  std::vector<int> original;               ///< of each copy, the vertex it is one of

  /// The number on the whole surface of a vertex of `surface`, or of a refined one.
  int whole(int v) const {
    const int copy = v - whole_vertices;
    if (copy < 0) return v;
    return copy < static_cast<int>(original.size()) ? original[copy] : v - static_cast<int>(original.size());
  }
};

/// Interior edges between two vertices of the boundary, or of curves, are split at their middles afterwards, as
/// `split_boundary_chords` does. O(V + F log F).
CutSurface cut_surface(const Mesh& mesh, const FeatureEdges& features);

/// Feature edges after some edges were split: each with its middle in the order in which they were made, the first of
/// which is `first_middle`; `ends` are the two vertices that each lies between.
FeatureEdges split_features(const FeatureEdges& features, const std::vector<std::array<int, 2>>& ends,
                            int first_middle);

}  // namespace gsp
