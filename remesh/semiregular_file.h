#pragma once

#include <string>
#include <vector>

#include "mesh/export.h"
#include "remesh/semiregular.h"

namespace GSP_PUBLIC gsp {

/// The comment by which a PLY file says that it is a semi-regular mesh.
inline constexpr const char* kSemiregularSignature = "gsp semiregular 1";

/// Writes `*.sr.ply`: a plain PLY (binary little-endian, double) with comments `gsp semiregular 1`, `level L`,
/// `base_vertices B`, `base_faces F` and then `provenance`, one "key value" a line, which says how the mesh was made
/// and is not read back. A displaced mesh also has the comment `control_grid G`, the element `control` with its control
/// points and a property `displacement` of its vertices, for other tools (docs/displaced.md). One with creases has the
/// comment `creases N` and the element `crease`. Throws Error(CannotWrite).
void write_semiregular(const std::string& path, const SemiregularMesh& mesh,
                       const std::vector<std::string>& provenance = {});

/// Reads what `write_semiregular` wrote; checks that the faces are those of the levels that the comments name.
/// Of a displaced mesh the control points are read, and held against the vertices; creases against the base edges.
/// Throws the errors of `read_mesh`, `displaced_form` and `base_level`, and NoSubdivisionConnectivity.
SemiregularMesh read_semiregular(const std::string& path);

}  // namespace gsp
