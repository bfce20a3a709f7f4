#pragma once

#include <string>
#include <vector>

namespace gsp::cli {

/// What an output file holds. An ending that stands for something else is refused; unknown endings and none are taken.
enum class Content {
  Ply,       ///< a map, semi-regular mesh or coloured surface
  Glb,       ///< binary glTF
  PlyOrGlb,  ///< as the ending says, PLY for others
  Stream,    ///< *.pgc
  Picture,   ///< PNG
  Csv,
  Json,
  Xml,
  Page,    ///< *.html
  Figure,  ///< the name of three: *.png, *.svg, *.gp
};

/// Whether a path has the ending of a content, in small or capital letters.
bool has_ending(const std::string& path, Content content);

/// The option of the output that every command with one needs.
inline constexpr const char* kRequired = "--output";

/// The paths on a command line by what they are for. The texts live in the caller.
struct CommandPaths {
  struct Output {
    std::string option;
    const std::string* path;  ///< empty where it is not asked for
    Content content;
  };
  std::vector<const std::string*> inputs;                    ///< files, or folders of a run
  std::vector<const std::vector<std::string>*> input_lists;  ///< files and folders
  std::vector<Output> outputs;
  const std::string* folder = nullptr;  ///< that is made where it is missing; null for none
  bool folder_beside_input = true;      ///< whether it may be the folder that is read
};

/// Checks outputs before any work begins. Links are followed and hard links known. Throws Error: BadOption where an
/// output is an input or another output, or its ending denies its content; CannotWrite where the folder it goes into is
/// not there or may not be written, and where a file is in the place of the folder.
void require_outputs(const CommandPaths& paths);

}  // namespace gsp::cli
