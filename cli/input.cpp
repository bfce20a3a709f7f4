#include "cli/input.h"

namespace gsp::cli {

SurfaceFile read_input(const std::string& path, const ReadOptions& options, Context& context) {
  SurfaceFile file = read_surface(path, options);
  for (const std::string& note : file.notes) context.console.say(path + ": " + note);
  return file;
}

}  // namespace gsp::cli
