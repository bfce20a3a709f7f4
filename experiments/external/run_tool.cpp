#include "experiments/external/run_tool.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "experiments/external/command_words.h"
#include "experiments/external/process.h"
#include "mesh/atomic_file.h"
#include "mesh/io.h"
#include "mesh/ply_elements.h"
#include "mesh/topology.h"
#include "remesh/recover_levels.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

constexpr double kVersionSeconds = 10.0;

// A folder of its own inside another; gone with all that is in it.
class Scratch {
 public:
  explicit Scratch(const std::string& folder) {
    fs::create_directories(folder);
    path_ = fs::absolute(folder).string() + "/external-XXXXXX";
    if (!::mkdtemp(path_.data()))
      throw Error(Cause::CannotWrite, "cannot make a folder in " + folder + ": " + std::strerror(errno));
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + '/' + name; }

 private:
  std::string path_;
};

// Not every program reads doubles from PLY; Draco's tools do not.
std::string write_input(const Scratch& scratch, const std::string& format, const Mesh& surface) {
  const std::string path = scratch.file("input." + format);
  if (format != "ply") {
    write_mesh(path, surface);
    return path;
  }
  PlyElement vertices = ply_vertices(surface);
  for (PlyProperty& property : vertices.properties) property.type = PlyType::Float32;
  AtomicFile file(path);
  write_ply(file.stream(), {{}, {vertices, ply_faces(surface)}});
  file.commit();
  return path;
}

std::string sentence(const ExternalTool& tool, const ProcessEnd& end) {
  std::string what;
  if (end.timed_out)
    what = fmt::format("was still running after {} s", tool.time_limit);
  else if (end.signal != 0)
    what = fmt::format("was ended by signal {} ({})", end.signal, ::strsignal(end.signal));
  else
    what = fmt::format("ended with status {}", end.status);
  if (!end.succeeded() && !end.timed_out && tool.memory_limit)
    what += fmt::format(", under a limit of {} MB", *tool.memory_limit);
  return what + (end.last_lines.empty() ? "" : ": " + end.last_lines);
}

std::string called(const ExternalTool& tool, const std::string& value) {
  return tool.name + (value.empty() ? "" : " " + value);
}

// One command, which must leave a file at `output`.
void run_command(const ExternalTool& tool, const std::string& line, const std::string& value, const std::string& input,
                 const std::string& output, const Scratch& scratch, Progress& progress) {
  const std::vector<std::string> words =
      command_words(line, {{"input", input}, {"output", output}, {"value", value}, {"folder", tool.folder}});
  const std::string doing = called(tool, value) + ": " + words.front();
  const ProcessEnd end = run_process(words, {tool.time_limit, tool.memory_limit}, scratch.path(), doing, progress);
  if (!end.succeeded())
    throw Error(end.timed_out ? Cause::TimedOut : Cause::ToolFailed, doing + ' ' + sentence(tool, end));
  std::error_code none;
  if (!fs::is_regular_file(output, none) || fs::file_size(output, none) == 0)
    throw Error(Cause::ToolFailed, doing + " wrote no output; it " + sentence(tool, end));
}

// What a tool wrote is told apart from what we read ourselves.
template <class Read>
auto read_output(const ExternalTool& tool, const std::string& value, Read read) try {
  return read();
} catch (const Error& error) {
  throw error.within("what " + called(tool, value) + " wrote");
}

// The file that a word of a command names; empty where there is none.
std::string named_file(const std::string& word, bool program) {
  std::error_code none;
  if (word.find('/') != std::string::npos) return fs::is_regular_file(word, none) ? word : "";
  if (!program) return "";
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + '/' + word; ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file))
      return file;
  return "";
}

}  // namespace

void run_codec(const ExternalTool& tool, const Mesh& surface, const std::string& folder, Progress& progress,
               const std::function<void(CodedSurface)>& point) {
  const Scratch scratch(folder);
  const std::string input = write_input(scratch, tool.input, surface);
  for (const std::string& value : tool.values) {
    const std::string coded = scratch.file("coded-" + value);
    const std::string decoded = scratch.file("decoded-" + value + '.' + tool.output);
    run_command(tool, tool.encode, value, input, coded, scratch, progress);
    const std::size_t bytes = fs::file_size(coded);
    run_command(tool, tool.decode, value, coded, decoded, scratch, progress);
    Mesh mesh = read_output(tool, value, [&] {
      Mesh read = read_mesh(decoded);
      require_finite_surface(read);
      return read;
    });
    point({value, bytes, std::move(mesh)});
    fs::remove(coded);
    fs::remove(decoded);
  }
}

SemiregularMesh run_remesher(const ExternalTool& tool, const Mesh& surface, const std::string& folder,
                             Progress& progress) {
  const Scratch scratch(folder);
  const std::string input = write_input(scratch, tool.input, surface);
  const std::string output = scratch.file("output." + tool.output);
  const std::string& value = tool.values.front();
  run_command(tool, tool.remesh, value, input, output, scratch, progress);
  return read_output(tool, value, [&] {
    SemiregularMesh mesh = read_or_recover(output);
    require_finite_surface(mesh.mesh());
    return mesh;
  });
}

std::string printed_version(const ExternalTool& tool) {
  if (tool.version_command.empty()) return "";
  try {
    const Scratch scratch(fs::temp_directory_path().string());
    Progress silent;
    const ProcessEnd end = run_process(command_words(tool.version_command, {{"folder", tool.folder}}),
                                       {.seconds = kVersionSeconds}, scratch.path(), "version", silent);
    return end.succeeded() ? end.output.substr(0, end.output.find('\n')) : "";
  } catch (const Error&) {
    return "";
  }
}

std::vector<std::string> files_of(const ExternalTool& tool) {
  if (tool.kind == ExternalTool::Kind::Points) return {tool.points};
  std::vector<std::string> files;
  for (const std::string* line : {&tool.encode, &tool.decode, &tool.remesh}) {
    if (line->empty()) continue;
    bool program = true;
    for (const std::string& word :
         command_words(*line, {{"input", ""}, {"output", ""}, {"value", ""}, {"folder", tool.folder}})) {
      const std::string file = named_file(word, program);
      if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
      program = false;
    }
  }
  return files;
}

}  // namespace gsp
