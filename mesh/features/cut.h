#pragma once

#include <vector>

#include "mesh/features/features.h"

namespace gsp {

/// A surface cut open along some of its edges.
struct CutMesh {
  Mesh mesh;                  ///< faces in their order; vertices keep their numbers, further copies of them come last
  std::vector<int> original;  ///< #V the vertex of the whole surface that it is a copy of, or itself
};

/// Cuts a manifold surface along interior edges: every vertex on them becomes one for each of the pieces into which
/// they cut the faces around it. An end of a cut inside the surface stays a single vertex. O(V + F log F).
CutMesh cut_along(const Mesh& mesh, const FeatureEdges& edges);

/// The inverse: every vertex becomes its original again.
Mesh glue(const CutMesh& cut);

}  // namespace gsp
