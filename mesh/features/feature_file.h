#pragma once

#include <string>

#include "mesh/features/features.h"

namespace gsp {

/// Reads feature edges of a mesh from a text file, in one of two forms:
/// - that of quad remeshers (QuadWild's `*.sharp`): the number of rows, then a row "type,face,edge" for each, type 0
///   concave or 1 convex, edge k from corner k of the face to the next;
/// - a plain list: a row of two vertices for each edge.
/// Numbers are separated by blanks or commas, and count from 0. Edges on the boundary are left out, since it is a
/// feature anyway; one that is named twice counts once. Throws Error: CannotOpen, Malformed with the line,
/// IndexOutOfRange, Malformed for two vertices that no edge joins, and what `require_parameterizable` throws: numbers
/// are those of the mesh as it is given, after its weld and repair. O(n log n + F log F).
FeatureEdges read_features(const std::string& path, const Mesh& mesh);

}  // namespace gsp
