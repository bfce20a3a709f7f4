#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesh/surface_file.h"

namespace gsp {

/// The surface formats, behind `read_surface` and `write_mesh`; public for tests and fuzzers that have bytes, not
/// files.
enum class MeshFormat { Ply, Obj, Off, Stl };

/// By the name's ending, case-insensitive.
std::optional<MeshFormat> format_of(const std::string& path);

/// Parses the bytes of a whole file. Throws the errors of `read_surface` except CannotOpen and UnknownFormat.
/// Memory stays under a small multiple of the bytes, whatever they claim.
SurfaceFile parse_surface(MeshFormat format, std::string_view bytes);

SurfaceFile parse_ply_mesh(std::string_view bytes);
SurfaceFile parse_obj(std::string_view bytes);
SurfaceFile parse_off(std::string_view bytes);
SurfaceFile parse_stl(std::string_view bytes);

}  // namespace gsp
