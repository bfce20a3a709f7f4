#include "cli/input.h"

#include "mesh/read_file.h"

namespace gsp::cli {

SurfaceFile read_input(const std::string& path, const ReadOptions& options, Context& context) {
  SurfaceFile file = read_surface(path, options);
  for (const std::string& note : file.notes) context.console.say(path + ": " + note);
  return file;
}

Bytes read_stream(const std::string& path) {
  const std::string bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

}  // namespace gsp::cli
