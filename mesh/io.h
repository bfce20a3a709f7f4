#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Reads a surface from PLY (ASCII, binary, both byte orders), OBJ, OFF or STL (ASCII, binary) by the name's ending,
/// case-insensitive, in double. Polygons are triangulated as fans, triangle strips of PLY are unrolled, polygons of
/// fewer than three corners are dropped, vertices of an STL that agree exactly are welded, isolated vertices are kept,
/// vertex order is the file's. No topological check is made, and coordinates that are not finite are kept, so that a
/// report can name them: see `topology.h`. The parsers are our own and not OpenMesh's: those of 9.0 pass every
/// coordinate through `float`, take indices out of range and truncated OFF files for good, return uninitialised memory
/// for "nan", and end in bad_alloc where a count lies. tests/mesh/openmesh_test.cpp holds the two against each other on
/// what both can read. Throws Error: CannotOpen, UnknownFormat, Malformed, Truncated, IndexOutOfRange, with the place.
Mesh read_mesh(const std::string& path);

/// Writes by the name's ending: PLY (binary little-endian, double), OBJ, OFF (shortest decimals that read back as the
/// same numbers), STL (binary, single precision). `comments` go into the formats that have them, all but STL. The file
/// is written whole under another name and renamed, so a reader never sees half of one. Throws Error: UnknownFormat,
/// CannotWrite.
void write_mesh(const std::string& path, const Mesh& mesh, const std::vector<std::string>& comments = {});

}  // namespace gsp
