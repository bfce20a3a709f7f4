#pragma once

#include <string>

#include "coder/codec.h"

namespace gsp {

/// The bytes of a *.pgc, whatever they hold. Throws Error(CannotOpen).
Bytes read_stream(const std::string& path);

/// Writes them, whole or not at all. Throws Error(CannotWrite).
void write_stream(const std::string& path, const Bytes& stream);

}  // namespace gsp
