#pragma once

#include <string>

#include "mesh/export.h"
#include "mesh/io.h"
#include "remesh/semiregular.h"

namespace GSP_PUBLIC gsp {

/// The base and the levels of a plain mesh with subdivision connectivity, as many levels as there are, at least one:
/// each quadrisection is undone by telling its old vertices from its new ones (Taubin 2002, "Detecting and
/// reconstructing subdivision connectivity"). Old vertices are found from one of each component by walking two edges
/// straight on, new ones must be regular. Several components and boundaries are fine; isolated vertices are dropped.
/// Throws NoSubdivisionConnectivity with the vertex or face that fits no quadrisection, and the errors of `base_level`.
/// O(V + F).
SemiregularMesh recover_levels(const Mesh& mesh);

/// Reads `*.sr.ply` as such, any other mesh, and one that is to be welded, by recovering its levels. Throws the errors
/// of `read_surface` and `recover_levels`.
SemiregularMesh read_or_recover(const std::string& path, const ReadOptions& options = {});

}  // namespace gsp
