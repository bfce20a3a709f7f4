#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gsp::cli {

/// A page or a completion file of the program, under `share` of where it is installed.
struct ManualFile {
  std::string path;  ///< "man/man1/gsp-remesh.1"
  std::string text;
};

/// Man pages of the program and of each command, and the completions of bash, zsh and fish. They follow from the
/// options as they were added, the same from which --help is made, so none is forgotten.
std::vector<ManualFile> manual(const CLI::App& app);

}  // namespace gsp::cli
