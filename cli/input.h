#pragma once

#include <string>

#include "cli/command.h"
#include "coder/codec.h"
#include "mesh/io.h"

namespace gsp::cli {

/// `read_surface`, and says what it noted.
SurfaceFile read_input(const std::string& path, const ReadOptions& options, Context& context);

/// The bytes of a *.pgc. Throws Error(CannotOpen).
Bytes read_stream(const std::string& path);

}  // namespace gsp::cli
