#pragma once

#include <string>

namespace gsp {

/// The bytes of a regular file. Throws Error(CannotOpen) with the system's reason.
std::string read_file(const std::string& path);

}  // namespace gsp
