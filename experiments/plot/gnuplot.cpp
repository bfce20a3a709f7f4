#include "experiments/plot/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "experiments/output/quoting.h"
#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

extern char** environ;

namespace gsp {

namespace {

class ScratchFolder {
 public:
  explicit ScratchFolder(std::string path) : path_(std::move(path)) { make_folder(path_); }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// Runs gnuplot in `folder` on scripts there, each as if it were the only one. False where gnuplot fails on one.
bool run_gnuplot(const std::string& folder, const std::vector<std::string>& scripts) {
  std::vector<std::string> words = {"gnuplot"};
  for (const std::string& script : scripts) {
    if (words.size() > 1) words.insert(words.end(), {"-e", "reset session"});
    words.push_back(script);
  }
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
    throw Error(Cause::ToolMissing,
                std::string("cannot run gnuplot, which draws the figures: ") + std::strerror(failure));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string figure_script(const std::string& name, const std::string& setup, const std::string& commands, int width,
                          int height) {
  std::string script =
      fmt::format("# Draws {0}.png and {0}.svg: run gnuplot on this file.\n{1}", gnuplot_comment(name), setup);
  for (const auto& [terminal, ending] : {std::pair{"pngcairo", "png"}, std::pair{"svg", "svg"}})
    script += fmt::format("set terminal {} size {},{} background rgb 'white'\nset output {}\n{}unset output\n",
                          terminal, width, height, gnuplot_quoted(name + "." + ending), commands);
  return script;
}

std::vector<std::string> figure_files(const std::string& name) { return {name + ".png", name + ".svg", name + ".gp"}; }

void draw_figures(const std::string& folder, const std::vector<FigureProgram>& figures) {
  std::vector<std::string> programs;
  for (const auto& [name, script] : figures) {
    const std::string program = figure_files(name).back();
    write_file(folder + "/" + program, script);
    programs.push_back("../" + program);
  }
  if (figures.empty()) return;
  // Drawn in a folder of its own and brought over as a whole, so that an interrupt leaves no half of a figure.
  const ScratchFolder scratch(folder + "/.plot-" + std::to_string(::getpid()));
  if (!run_gnuplot(scratch.path(), programs)) {
    // One by one, so that the error names the figure.
    for (const std::string& program : programs)
      if (!run_gnuplot(scratch.path(), {program}))
        throw Error(Cause::ToolMissing, "gnuplot failed on " + folder + program.substr(2));
  }
  for (const FigureProgram& figure : figures) {
    const std::vector<std::string> files = figure_files(figure.name);
    for (const std::string& picture : {files[0], files[1]})
      write_file(folder + "/" + picture, read_file(scratch.path() + "/" + picture));
  }
}

std::vector<std::string> draw_figure(const std::string& folder, const std::string& name, const std::string& script) {
  draw_figures(folder, {{name, script}});
  return figure_files(name);
}

}  // namespace gsp
