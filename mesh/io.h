#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Reads a surface from PLY (ASCII, binary, both byte orders), OBJ, OFF or STL (ASCII, binary) by the name's ending,
/// case-insensitive, in double. Polygons are triangulated as fans, vertices of an STL that agree exactly are welded,
/// isolated vertices are kept, vertex order is the file's. No topological check is made: see `topology.h`.
/// Throws Error: CannotOpen, UnknownFormat, Malformed, Truncated, IndexOutOfRange (with the place), NonFinite.
Mesh read_mesh(const std::string& path);

/// Writes by the name's ending: PLY (binary little-endian, double), OBJ, OFF, STL (binary). `comments` go into formats
/// that have them. The file is written whole under another name and renamed, so a reader never sees half of one.
/// Throws Error: UnknownFormat, CannotWrite.
void write_mesh(const std::string& path, const Mesh& mesh, const std::vector<std::string>& comments = {});

}  // namespace gsp
