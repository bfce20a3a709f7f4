#pragma once

#include "mesh/cut_apart.h"
#include "mesh/features/features.h"

namespace gsp {

/// Cuts a manifold surface along interior edges: every vertex on them becomes one for each of the pieces into which
/// they cut the faces around it. An end of a cut inside the surface stays a single vertex. O(V + F log F).
CutMesh cut_along(const Mesh& mesh, const FeatureEdges& edges);

/// The inverse: every vertex becomes its original again.
Mesh glue(const CutMesh& cut);

}  // namespace gsp
