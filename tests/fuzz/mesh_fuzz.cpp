#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "mesh/error.h"
#include "mesh/io.h"
#include "mesh/topology.h"
#include "remesh/recover_levels.h"
#include "remesh/semiregular_file.h"

/// The first byte chooses the format, the rest is the file: every reader must read it or refuse it by name, and so must
/// what looks for subdivision connectivity in what was read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::array<std::string, 5> kEndings = {".ply", ".obj", ".off", ".stl", ".sr.ply"};
  const std::size_t format = data[0] % kEndings.size();
  static const std::string stem =
      (std::filesystem::temp_directory_path() / ("gsp-fuzz-" + std::to_string(getpid()))).string();
  const std::string path = stem + kEndings[format];
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data + 1), static_cast<long>(size - 1));
  try {
    if (format == 4)
      gsp::read_semiregular(path);
    else
      gsp::recover_levels(gsp::read_mesh(path));
  } catch (const gsp::Error&) {
  }
  return 0;
}
