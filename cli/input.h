#pragma once

#include <string>

#include "cli/command.h"
#include "mesh/io.h"

namespace gsp::cli {

/// `read_surface`, and says what it noted.
SurfaceFile read_input(const std::string& path, const ReadOptions& options, Context& context);

}  // namespace gsp::cli
