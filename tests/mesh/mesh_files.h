#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/error.h"
#include "mesh/files/formats.h"

/// The same two triangles of a square in every dialect that the readers must take, for tests that read them, cut them
/// and damage them.
struct MeshFile {
  const char* name;
  gsp::MeshFormat format;
  std::string bytes;
};

std::vector<MeshFile> square_files();
gsp::Mesh square();

/// The cause of the Error that the bytes give; empty where they are read.
std::optional<gsp::Cause> parse_cause(gsp::MeshFormat format, std::string_view bytes);
