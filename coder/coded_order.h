#pragma once

#include <vector>

#include "coder/base_connectivity.h"
#include "remesh/semiregular.h"

namespace gsp {

/// #V of the finest level: the vertex of a mesh with `mesh`'s base that a decoder will give this index. Coding
/// renumbers base vertices and faces and turns faces' corners, and with them every finer vertex. O(V + F).
std::vector<int> coded_vertex_order(const SemiregularMesh& mesh, const CodedBase& base);

/// The mesh as a decoder will number it.
SemiregularMesh in_coded_order(const SemiregularMesh& mesh, const CodedBase& base);

}  // namespace gsp
