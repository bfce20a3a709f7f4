#pragma once

#include <string>

#include "mesh/export.h"
#include "param/map/parameterization.h"

namespace GSP_PUBLIC gsp {

/// Writes `*.param.ply` as design.md gives it (binary little-endian PLY, texture coordinates are chart positions),
/// whole and then renamed. Throws Error(CannotWrite) and the errors of `require_well_formed`.
void write_parameterization(const std::string& path, const Parameterization& map);

/// Reads `*.param.ply`. Checks every index and count against the file before it takes memory.
/// Throws Error: CannotOpen, Malformed, Truncated, IndexOutOfRange, NonFinite.
Parameterization read_parameterization(const std::string& path);

}  // namespace gsp
