#include "cli/output_paths.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "mesh/error.h"

namespace gsp::cli {

namespace {

namespace fs = std::filesystem;

struct Ending {
  const char* ending;
  std::optional<Content> content;  ///< empty for what no command writes by that name
};

constexpr Ending kEndings[] = {{".ply", Content::Ply},
                               {".glb", Content::Glb},
                               {".pgc", Content::Stream},
                               {".png", Content::Picture},
                               {".csv", Content::Csv},
                               {".json", Content::Json},
                               {".xml", Content::Xml},
                               {".obj", {}},
                               {".off", {}},
                               {".stl", {}},
                               {".svg", {}},
                               {".gp", {}},
                               {".toml", {}},
                               {".html", Content::Page},
                               {".gltf", {}},
                               {".sqlite", {}},
                               {".jpg", {}},
                               {".jpeg", {}},
                               {".gif", {}},
                               {".pdf", {}}};

const char* ending_of(Content content) {
  if (content == Content::PlyOrGlb) return ".ply or *.glb";
  for (const Ending& known : kEndings)
    if (known.content == content) return known.ending;
  return ".png";
}

std::string small_ending(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool denies(const std::string& path, Content content) {
  const std::string ending = small_ending(path);
  if (content == Content::Figure && (ending == ".svg" || ending == ".gp" || ending == ".png")) return false;
  if (content == Content::PlyOrGlb && ending == ".glb") return false;
  if (content == Content::PlyOrGlb) content = Content::Ply;
  const auto known =
      std::find_if(std::begin(kEndings), std::end(kEndings), [&](const Ending& e) { return ending == e.ending; });
  return known != std::end(kEndings) && known->content != content;
}

// The same file or folder, whatever links lead to it; also where it is not there yet.
bool same(const std::string& a, const std::string& b) {
  std::error_code failed;
  if (fs::equivalent(a, b, failed)) return true;
  const fs::path one = fs::weakly_canonical(a, failed), other = fs::weakly_canonical(b, failed);
  return !failed && one == other;
}

// The files that an output of that name is made of.
std::vector<std::string> files_of(const CommandPaths::Output& output) {
  if (output.content != Content::Figure) return {*output.path};
  std::vector<std::string> files;
  for (const char* ending : {".png", ".svg", ".gp"}) files.push_back(fs::path(*output.path).replace_extension(ending));
  return files;
}

// An input itself and, where it is the folder of a run, the files that are read in it.
std::vector<std::string> files_read(const CommandPaths& paths) {
  std::vector<std::string> files;
  for (const std::string* input : paths.inputs) {
    files.push_back(*input);
    for (const char* inside : {"/results.sqlite", "/curve.csv"}) files.push_back(*input + inside);
  }
  for (const std::vector<std::string>* list : paths.input_lists) files.insert(files.end(), list->begin(), list->end());
  return files;
}

void require_writable_folder(const std::string& file) {
  const fs::path parent = fs::path(file).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  std::error_code failed;
  if (fs::is_directory(file, failed))
    throw Error(Cause::CannotWrite, "cannot write " + file + ": a folder is in its place");
  if (!fs::is_directory(folder, failed))
    throw Error(Cause::CannotWrite, "cannot write " + file + ": there is no folder " + folder);
  // What is there already, such as a device, may be written without its folder.
  if (::access(folder.c_str(), W_OK) != 0 && !fs::exists(file, failed))
    throw Error(Cause::CannotWrite, "cannot write " + file + ": " + folder + " may not be written");
}

void require_folder(const CommandPaths& paths) {
  const std::string& folder = *paths.folder;
  if (folder.empty()) throw Error(Cause::BadOption, "the name of the output folder is empty");
  std::error_code failed;
  fs::path above = folder;
  while (fs::status(above, failed).type() == fs::file_type::not_found && above.has_relative_path())
    above = above.parent_path();
  // The file may stand in the place of a folder on the way.
  if (fs::exists(above, failed) && !fs::is_directory(above, failed))
    throw Error(Cause::CannotWrite, "cannot make the folder " + folder + ": a file is in its place");
  if (paths.folder_beside_input) return;
  for (const std::string* input : paths.inputs)
    if (same(folder, *input))
      throw Error(Cause::BadOption, folder + " is the folder that is read; its files would be replaced");
}

}  // namespace

bool has_ending(const std::string& path, Content content) { return small_ending(path) == ending_of(content); }

void require_outputs(const CommandPaths& paths) {
  if (paths.folder) require_folder(paths);
  const std::vector<std::string> inputs = files_read(paths);
  std::vector<std::string> seen;
  for (const CommandPaths::Output& output : paths.outputs) {
    if (output.path->empty() && output.option != kRequired) continue;
    if (output.path->empty()) throw Error(Cause::BadOption, "the name of the output is empty");
    if (denies(*output.path, output.content))
      throw Error(Cause::BadOption, output.option + ": the ending of " + *output.path +
                                        " stands for another content; *" + ending_of(output.content) +
                                        " is what is written");
    for (const std::string& file : files_of(output)) {
      for (const std::string& input : inputs)
        if (same(file, input))
          throw Error(Cause::BadOption, output.option + " " + file + " would replace " + input + ", which is read");
      for (const std::string& other : seen)
        if (same(file, other))
          throw Error(Cause::BadOption, output.option + " " + file + " would replace another output");
      require_writable_folder(file);
      seen.push_back(file);
    }
  }
}

}  // namespace gsp::cli
