#pragma once

#include <string>
#include <string_view>

#include "mesh/mesh.h"

namespace gsp {

/// 128 bits as 32 hexadecimal digits (XXH3): tells contents apart, and is no protection against someone who forges one.
std::string content_hash(std::string_view bytes);

/// Of a file's bytes. Throws Error(CannotOpen).
std::string file_hash(const std::string& path);

/// Of positions and faces, in their order: the same surface from a PLY and an OBJ has the same.
std::string mesh_hash(const Mesh& mesh);

}  // namespace gsp
