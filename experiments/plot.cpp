#include "experiments/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "experiments/gnuplot.h"
#include "experiments/summary.h"

namespace gsp {

namespace {

struct Style {
  const char* method;
  const char* color;
};

// gsp stands out; the baselines and anchors keep colours that differ in lightness too.
constexpr Style kStyles[] = {{"gsp", "#c8102e"},
                             {"maps-smoothed", "#1f5fa8"},
                             {"maps", "#7fb2e5"},
                             {"decimate-draco", "#2b2b2b"},
                             {"draco", "#9a9a9a"}};
// Of other names, such as those of settings, in turn.
constexpr const char* kFurther[] = {"#6a3d9a", "#1b7f5c", "#c77a00", "#00829b", "#a6408c",
                                    "#5d7a00", "#7a5230", "#3b4cc0", "#d1495b", "#66a182"};
// More curves than this leave no room for a key inside the plot, nor for ceilings in it.
constexpr std::size_t kFewCurves = 6;

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
  std::vector<std::string> names;
  for (const CurveSeries& curve : curves) names.push_back(curve.name);
  const std::vector<std::string> colors = method_colors(names);
  std::string lines;
  for (std::size_t m = 0; m < curves.size(); ++m)
    lines +=
        fmt::format("{}{} using 1:2 with linespoints lw {} pt 7 ps 0.5 lc rgb '{}' title {}", m ? ", \\\n     " : "",
                    data_name(index, m), m == 0 ? 4 : 2, colors[m], gnuplot_quoted(names[m]));
  const bool few = curves.size() <= kFewCurves;
  for (std::size_t m = 0; m < curves.size(); ++m)
    if (const double ceiling = ceiling_db(curves[m].points); ceiling > 0.0)
      lines += fmt::format(", \\\n     {:.4f} with lines dt 2 lw 1 lc rgb '{}' {}", ceiling, colors[m],
                           few ? "title " + gnuplot_quoted(names[m] + " remesh (ceiling)") : "notitle");
  const auto [low, high] = byte_range(points);
  return fmt::format(
      "set title {} noenhanced\nset key {}\nset xtics ({})\nset xrange [{:.0f}:{:.0f}]\nset yrange [*:{}]\nplot {}\n",
      gnuplot_quoted(model), few ? "inside bottom right" : "outside right center", byte_tics(low, high), low, high,
      highest_shown(points), lines);
}

}  // namespace

std::vector<std::string> method_colors(const std::vector<std::string>& methods) {
  std::vector<std::string> colors;
  std::size_t next = 0;
  for (const std::string& method : methods) {
    const auto known =
        std::find_if(std::begin(kStyles), std::end(kStyles), [&](const Style& s) { return method == s.method; });
    colors.push_back(known != std::end(kStyles) ? known->color : kFurther[next++ % std::size(kFurther)]);
  }
  return colors;
}

std::string plot_script(const std::string& name, const std::vector<PlotPanel>& panels) {
  std::string setup =
      "set logscale x 2\nset grid back lt 1 lw 1 lc rgb '#e4e4e4'\nset key Left reverse noenhanced\n"
      "set xlabel 'bytes'\nset ylabel 'PSNR in dB (diagonal / RMS)'\n";
  std::string commands;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    setup += panel_data(panels[i].second, i);
    commands += panel_commands(panels[i], i);
  }
  const bool several = panels.size() > 1;
  const int width = several ? 640 * static_cast<int>(panels.size()) : 900;
  if (several) commands = fmt::format("set multiplot layout 1,{}\n{}unset multiplot\n", panels.size(), commands);
  return figure_script(name, setup, commands, width, 600);
}

std::vector<std::string> plot(const std::string& folder, const std::string& name,
                              const std::vector<PlotPanel>& panels) {
  return draw_figure(folder, name, plot_script(name, panels));
}

}  // namespace gsp
