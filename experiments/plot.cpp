#include "experiments/plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "experiments/summary.h"
#include "mesh/atomic_file.h"

extern char** environ;

namespace gsp {

namespace {

struct Style {
  const char* method;
  const char* color;
  int width;
};

// gsp stands out; the baselines and anchors keep colours that differ in lightness too.
constexpr Style kStyles[] = {{"gsp", "#c8102e", 4},
                             {"maps-smoothed", "#1f5fa8", 2},
                             {"maps", "#7fb2e5", 2},
                             {"decimate-draco", "#2b2b2b", 2},
                             {"draco", "#9a9a9a", 2}};
constexpr Style kOther = {"", "#6a3d9a", 2};

const Style& style_of(const std::string& method) {
  for (const Style& style : kStyles)
    if (method == style.method) return style;
  return kOther;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (char c : text)
    if (c == '\'')
      result += "''";
    else
      result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  return result + "'";
}

// Bytes from the first point to the last that any progressive method has: the anchors' tails would only shrink the
// rest.
std::pair<double, double> byte_range(const std::vector<CurvePoint>& points) {
  double low = 256.0, high = 1024.0;
  for (const CurvePoint& p : points) {
    low = std::min(low, static_cast<double>(p.bytes));
    if (p.remesh_error > 0.0) high = std::max(high, static_cast<double>(p.bytes));
  }
  return {low, high};
}

// A little above the highest ceiling: Draco, which has none, would push everything else down.
std::string highest_shown(const std::vector<CurvePoint>& points) {
  double ceiling = 0.0;
  for (const CurvePoint& p : points)
    if (p.remesh_error > 0.0) ceiling = std::max(ceiling, -20.0 * std::log10(p.remesh_error));
  return ceiling > 0.0 ? fmt::format("{:.1f}", ceiling + 3.0) : "*";
}

std::string byte_tics(double low, double high) {
  std::string tics;
  for (double bytes = 64.0; bytes <= 2.0 * high; bytes *= 4.0) {
    if (bytes < 0.5 * low) continue;
    const std::string label = bytes < 1024.0      ? fmt::format("{:.0f} B", bytes)
                              : bytes < 1048576.0 ? fmt::format("{:.0f} KB", bytes / 1024.0)
                                                  : fmt::format("{:.0f} MB", bytes / 1048576.0);
    tics += fmt::format("{}'{}' {:.0f}", tics.empty() ? "" : ", ", label, bytes);
  }
  return tics;
}

std::string data_name(std::size_t panel, std::size_t method) { return fmt::format("$d{}_{}", panel, method); }

std::string panel_data(const std::vector<CurvePoint>& points, std::size_t panel) {
  const std::vector<CurveSeries> curves = by_method(points);
  std::string script;
  for (std::size_t m = 0; m < curves.size(); ++m) {
    script += data_name(panel, m) + " << EOD\n";
    for (const RatePoint& point : envelope_of(curves[m].points))
      script += fmt::format("{:.0f} {:.4f}\n", point.bytes, point.psnr_db);
    script += "EOD\n";
  }
  return script;
}

std::string panel_commands(const PlotPanel& panel, std::size_t index) {
  const auto& [model, points] = panel;
  const std::vector<CurveSeries> curves = by_method(points);
  std::string lines;
  for (std::size_t m = 0; m < curves.size(); ++m) {
    const Style& style = style_of(curves[m].name);
    lines += fmt::format("{}{} using 1:2 with linespoints lw {} pt 7 ps 0.5 lc rgb '{}' title {}",
                         m ? ", \\\n     " : "", data_name(index, m), style.width, style.color, quoted(curves[m].name));
  }
  for (const CurveSeries& curve : curves)
    if (const double ceiling = ceiling_db(curve.points); ceiling > 0.0)
      lines += fmt::format(", \\\n     {:.4f} with lines dt 2 lw 1 lc rgb '{}' title {}", ceiling,
                           style_of(curve.name).color, quoted(curve.name + " remesh (ceiling)"));
  const auto [low, high] = byte_range(points);
  return fmt::format(
      "set title {} noenhanced\nset xtics ({})\nset xrange [{:.0f}:{:.0f}]\nset yrange [*:{}]\nplot {}\n",
      quoted(model), byte_tics(low, high), low, high, highest_shown(points), lines);
}

class ScratchFolder {
 public:
  explicit ScratchFolder(std::string path) : path_(std::move(path)) { std::filesystem::create_directories(path_); }
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

// Runs gnuplot in `folder` on a script there.
void run_gnuplot(const std::string& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot", argument = script;
  char* const argv[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
    throw Error(Cause::ToolMissing,
                std::string("cannot run gnuplot, which draws the figures: ") + std::strerror(failure));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(Cause::ToolMissing, "gnuplot failed on " + folder + "/" + script);
}

}  // namespace

std::string plot_script(const std::string& name, const std::vector<PlotPanel>& panels) {
  std::string script = fmt::format(
      "# Draws {0}.png and {0}.svg: run gnuplot on this file.\n"
      "set logscale x 2\nset grid back lt 1 lw 1 lc rgb '#e4e4e4'\nset key bottom right Left reverse noenhanced\n"
      "set xlabel 'bytes'\nset ylabel 'PSNR in dB (diagonal / RMS)'\n",
      name);
  std::string commands;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    script += panel_data(panels[i].second, i);
    commands += panel_commands(panels[i], i);
  }
  const bool several = panels.size() > 1;
  const int width = several ? 640 * static_cast<int>(panels.size()) : 900;
  if (several) commands = fmt::format("set multiplot layout 1,{}\n{}unset multiplot\n", panels.size(), commands);
  for (const auto& [terminal, ending] : {std::pair{"pngcairo", "png"}, std::pair{"svg", "svg"}})
    script += fmt::format("set terminal {} size {},600 background rgb 'white'\nset output {}\n{}unset output\n",
                          terminal, width, quoted(name + "." + ending), commands);
  return script;
}

std::vector<std::string> plot(const std::string& folder, const std::string& name,
                              const std::vector<PlotPanel>& panels) {
  AtomicFile script(folder + "/" + name + ".gp");
  script.stream() << plot_script(name, panels);
  script.commit();
  const std::vector<std::string> figures = {name + ".png", name + ".svg"};
  // Drawn in a folder of its own and moved, so that an interrupt leaves no half of a figure.
  const ScratchFolder scratch(folder + "/.plot-" + std::to_string(::getpid()));
  run_gnuplot(scratch.path(), "../" + name + ".gp");
  for (const std::string& figure : figures)
    std::filesystem::rename(scratch.path() + "/" + figure, folder + "/" + figure);
  return {figures[0], figures[1], name + ".gp"};
}

}  // namespace gsp
