#include "experiments/external/external.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "experiments/cells/command_words.h"
#include "experiments/cells/points_file.h"
#include "experiments/external/process.h"
#include "experiments/store/content_hash.h"
#include "mesh/io.h"
#include "remesh/recover_levels.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

// A folder of its own inside another; gone with all that is in it.
class Scratch {
 public:
  explicit Scratch(const std::string& folder) : path_(folder + "/external-XXXXXX") {
    fs::create_directories(folder);
    if (!::mkdtemp(path_.data()))
      throw Error(Cause::CannotWrite, "cannot make a folder in " + folder + ": " + std::strerror(errno));
    // Programs may run elsewhere.
    path_ = fs::absolute(path_).string();
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

// One command, which must leave a file at `output`.
void run(const ExternalTool& tool, const std::string& line, const std::string& value, const std::string& input,
         const std::string& output, const Scratch& scratch, Progress& progress) {
  const std::vector<std::string> words = command_words(
      line, {{"input", input}, {"output", output}, {"value", value}, {"folder", tool.folder}});
  const std::string doing = tool.name + (value.empty() ? "" : " " + value) + ": " + words.front();
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
  throw error.within(tool.name + (value.empty() ? "" : " " + value));
}

std::vector<CurvePoint> codec_curve(const ExternalTool& tool, const Meter& meter, std::size_t samples,
                                    const std::string& folder, Progress& progress) {
  const Scratch scratch(folder);
  const std::string input = scratch.file("input." + tool.input);
  write_mesh(input, meter.mesh());
  std::vector<CurvePoint> points;
  for (const std::string& value : tool.values) {
    const std::string coded = scratch.file("coded-" + value), decoded = scratch.file("decoded-" + value + '.' + tool.output);
    run(tool, tool.encode, value, input, coded, scratch, progress);
    run(tool, tool.decode, value, coded, decoded, scratch, progress);
    points.push_back(read_output(tool, value, [&] {
      Progress silent;
      return meter.measure(read_mesh(decoded), fs::file_size(coded), samples, silent);
    }));
    points.back().coder = tool.name + (value.empty() ? "" : " " + value);
    fs::remove(coded);
    fs::remove(decoded);
  }
  return points;
}

std::vector<CurvePoint> file_curve(const ExternalTool& tool, const Meter& meter) {
  std::vector<CurvePoint> points;
  for (const ForeignPoint& foreign : read_points_file(tool.points)) {
    if (foreign.model != meter.model()) continue;
    if (foreign.vertices && *foreign.vertices != meter.mesh().vertex_count())
      throw Error(Cause::BadOption, fmt::format("{} is about a surface {} of {} vertices; this one has {}", tool.points,
                                                foreign.model, *foreign.vertices, meter.mesh().vertex_count()));
    CurvePoint& point = points.emplace_back();
    point.model = foreign.model;
    point.coder = foreign.label;
    point.bytes = foreign.bytes;
    point.bits_per_vertex = 8.0 * static_cast<double>(foreign.bytes) / meter.mesh().vertex_count();
    point.psnr_db = foreign.psnr_db;
    point.rms = std::pow(10.0, -foreign.psnr_db / 20.0);
  }
  if (points.empty()) throw Error(Cause::BadOption, tool.points + " has no points of " + meter.model());
  return points;
}

// The file that a program's name stands for; empty where there is none.
std::string program_file(const std::string& name) {
  if (name.find('/') != std::string::npos) return fs::is_regular_file(name) ? name : "";
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + '/' + name; ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file))
      return file;
  return "";
}

std::string file_version(const std::string& file) {
  try {
    return file.empty() ? "none" : file_hash(file);
  } catch (const Error&) {
    return "none";
  }
}

}  // namespace

std::vector<CurvePoint> external_curve(const ExternalTool& tool, const Meter& meter, std::size_t samples,
                                       const std::string& folder, Progress& progress) {
  return tool.kind == ExternalTool::Kind::Points ? file_curve(tool, meter)
                                                 : codec_curve(tool, meter, samples, folder, progress);
}

SemiregularMesh external_remesh(const ExternalTool& tool, const Mesh& surface, const std::string& folder,
                                Progress& progress) {
  const Scratch scratch(folder);
  const std::string input = scratch.file("input." + tool.input), output = scratch.file("output." + tool.output);
  const std::string& value = tool.values.front();
  write_mesh(input, surface);
  run(tool, tool.remesh, value, input, output, scratch, progress);
  return read_output(tool, value, [&] { return read_or_recover(output); });
}

std::string version_of(const ExternalTool& tool) {
  if (tool.kind == ExternalTool::Kind::Points) return file_version(tool.points);
  const std::map<std::string, std::string> values = {
      {"input", ""}, {"output", ""}, {"value", ""}, {"folder", tool.folder}};
  std::string version;
  for (const std::string* line : {&tool.encode, &tool.decode, &tool.remesh})
    if (!line->empty()) version += file_version(program_file(command_words(*line, values).front())) + ' ';
  if (tool.version_command.empty()) return version;
  constexpr double kSeconds = 10.0;
  try {
    const Scratch scratch(fs::temp_directory_path().string());
    Progress silent;
    const ProcessEnd end =
        run_process(command_words(tool.version_command, values), {.seconds = kSeconds}, scratch.path(), "version", silent);
    return version + end.output.substr(0, end.output.find('\n'));
  } catch (const Error&) {
    return version;
  }
}

}  // namespace gsp
