#include "test_meshes.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

namespace {

std::string folder(const char* variable, const char* otherwise) {
  const char* named = std::getenv(variable);
  const std::string path = named ? named : otherwise;
  if (std::filesystem::is_directory(path)) return path;
  WARN("skipped: there is no folder " << path << " (" << variable << ")");
  return {};
}

}  // namespace

std::string shared_meshes() { return folder("GSP_SHARED_MESHES", GSP_SOURCE_DIR "/../shared/meshes"); }

std::string sample_meshes() { return folder("GSP_SAMPLES", GSP_SOURCE_DIR "/out/samples"); }
