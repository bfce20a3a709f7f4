#pragma once

#include <string>

#include "remesh/semiregular.h"

namespace gsp {

/// Writes a mesh as binary glTF 2.0: positions in single precision, in the mesh's own axes and units; and unit normals,
/// but not of a mesh with creases, of which viewers shade faces flat then. With `levels` the coarser levels are in the
/// file too, as levels of detail (vendor extension MSFT_lod): the same vertices, of which a coarser level has the first
/// ones, each level for a quarter of the screen of the next finer one. Throws Error: CannotWrite; NonFinite with the
/// vertex where a coordinate is no number of single precision, TooSmall where single precision leaves a point;
/// Malformed where the mesh is not well formed. O(faces).
void write_glb(const std::string& path, const SemiregularMesh& mesh, bool levels);

}  // namespace gsp
