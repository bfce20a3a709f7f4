#include "experiments/plot/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "experiments/output/quoting.h"
#include "experiments/plot/gnuplot.h"

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
                             {"lindstrom-turk-draco", "#8a6d3b"},
                             {"draco", "#9a9a9a"}};
// Of other names, such as those of settings, in turn.
constexpr const char* kFurther[] = {"#6a3d9a", "#1b7f5c", "#c77a00", "#00829b", "#a6408c",
                                    "#5d7a00", "#7a5230", "#3b4cc0", "#d1495b", "#66a182"};
// More curves than this leave no room for a key inside the plot, nor for ceilings in it.
constexpr std::size_t kFewCurves = 6;
// Pixels of a figure of several panels.
constexpr int kPanelWidth = 640, kKeyWidth = 340;

// Bytes from the first point to the last that any progressive method has: the anchors' tails would only shrink the
// rest.
std::pair<double, double> byte_range(const std::vector<CurveSeries>& curves) {
  double low = 256.0, high = 1024.0;
  for (const CurveSeries& curve : curves)
    for (const auto& [replicate, points] : curve.runs)
      for (const CurvePoint& p : points) {
        low = std::min(low, static_cast<double>(p.bytes));
        if (p.remesh_error > 0.0) high = std::max(high, static_cast<double>(p.bytes));
      }
  return {low, high};
}

// A ceiling that has a height: that of an exact remesh is infinite.
std::optional<double> drawn_ceiling(const CurveSeries& curve) {
  const std::optional<double> ceiling = ceiling_db(curve);
  return ceiling && std::isfinite(*ceiling) ? ceiling : std::nullopt;
}

// What of its spread has a height.
std::vector<SpreadPoint> finite_spread(const CurveSeries& curve) {
  std::vector<SpreadPoint> spread = spread_of(curve);
  std::erase_if(spread, [](const SpreadPoint& point) { return std::isinf(point.mean_db); });
  return spread;
}

// Up to a little above the highest ceiling: Draco, which has none, would push everything else down. Where no point has
// a height, any range will do.
std::string heights(const std::vector<CurveSeries>& curves) {
  double ceiling = 0.0;
  bool any = false;
  for (const CurveSeries& curve : curves) {
    ceiling = std::max(ceiling, drawn_ceiling(curve).value_or(0.0));
    any = any || !finite_spread(curve).empty();
  }
  if (ceiling > 0.0) return fmt::format("[*:{:.1f}]", ceiling + 3.0);
  return any ? "[*:*]" : "[0:100]";
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

std::string data_name(std::size_t panel, std::size_t curve) { return fmt::format("$d{}_{}", panel, curve); }

std::string panel_data(const std::vector<CurveSeries>& curves, std::size_t panel) {
  std::string script;
  for (std::size_t m = 0; m < curves.size(); ++m) {
    script += data_name(panel, m) + " << EOD\n";
    for (const SpreadPoint& point : finite_spread(curves[m]))
      script +=
          fmt::format("{:.0f} {:.4f} {:.4f} {:.4f}\n", point.bytes, point.mean_db, point.lowest_db, point.highest_db);
    script += "EOD\n";
  }
  return script;
}

std::vector<std::string> curve_names(const std::vector<PlotPanel>& panels) {
  std::vector<std::string> names;
  for (const PlotPanel& panel : panels)
    for (const CurveSeries& curve : panel.second)
      if (std::find(names.begin(), names.end(), curve.name) == names.end()) names.push_back(curve.name);
  return names;
}

// How the curves of a figure look, the same in each of its panels.
class Looks {
 public:
  explicit Looks(std::vector<std::string> names) : names_(std::move(names)), colors_(method_colors(names_)) {}
  const std::vector<std::string>& names() const { return names_; }
  std::string curve(const std::string& name) const {
    const std::size_t i = place(name);
    // Discs, then squares, triangles, rhombs where colours come again.
    constexpr int kPoints[] = {7, 5, 9, 13};
    const auto again = std::count(colors_.begin(), colors_.begin() + static_cast<std::ptrdiff_t>(i), colors_[i]);
    return fmt::format("with linespoints lw {} pt {} ps {} lc rgb '{}'", i == 0 ? 4 : 2,
                       kPoints[static_cast<std::size_t>(again) % std::size(kPoints)], again ? 1.0 : 0.5, colors_[i]);
  }
  std::string band(const std::string& name) const {
    return fmt::format("with filledcurves fs transparent solid 0.2 noborder lc rgb '{}'", colors_[place(name)]);
  }
  std::string ceiling(const std::string& name) const {
    return fmt::format("with lines dt 2 lw 1 lc rgb '{}'", color(name));
  }
  const std::string& color(const std::string& name) const { return colors_[place(name)]; }

 private:
  std::size_t place(const std::string& name) const {
    return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
  }
  std::vector<std::string> names_, colors_;
};

// What a curve is called in the key: an exact size has no height, so it is told.
std::string title_of(const CurveSeries& curve) {
  const std::optional<double> exact = exact_from(curve);
  return gnuplot_quoted(curve.name + (exact ? fmt::format(" (exact from {:.0f} bytes)", *exact) : std::string()));
}

// Sizes from which on curves are exact, as dotted lines over all heights.
std::string exact_sizes(const std::vector<CurveSeries>& curves, const Looks& looks) {
  std::string commands = "unset arrow\n";
  for (const CurveSeries& curve : curves)
    if (const std::optional<double> bytes = exact_from(curve))
      commands += fmt::format("set arrow from {0:.0f}, graph 0 to {0:.0f}, graph 1 nohead dt 3 lw 2 lc rgb '{1}'\n",
                              *bytes, looks.color(curve.name));
  return commands;
}

// The curves of a panel and its ceilings, for `plot`. A curve without finite PSNR has its place in the key alone.
std::string panel_lines(const std::vector<CurveSeries>& curves, std::size_t index, const Looks& looks) {
  std::string lines;
  for (std::size_t m = 0; m < curves.size(); ++m)
    if (curves[m].runs.size() > 1 && !finite_spread(curves[m]).empty())
      lines += fmt::format("{} using 1:3:4 {} notitle, \\\n     ", data_name(index, m), looks.band(curves[m].name));
  for (std::size_t m = 0; m < curves.size(); ++m) {
    const std::string data = finite_spread(curves[m]).empty() ? "NaN" : data_name(index, m) + " using 1:2";
    lines +=
        fmt::format("{}{} {} title {}", m ? ", \\\n     " : "", data, looks.curve(curves[m].name), title_of(curves[m]));
  }
  const bool few = curves.size() <= kFewCurves;
  std::set<double> ceilings;
  for (const CurveSeries& curve : curves)  // those coded from one remesh share theirs
    if (const auto ceiling = drawn_ceiling(curve); ceiling && ceilings.insert(*ceiling).second)
      lines += fmt::format(", \\\n     {:.4f} {} {}", *ceiling, looks.ceiling(curve.name),
                           few ? "title " + gnuplot_quoted(curve.name + " remesh (ceiling)") : "notitle");
  return lines;
}

std::string panel_commands(const PlotPanel& panel, std::size_t index, const Looks& looks) {
  const auto& [model, curves] = panel;
  const auto [low, high] = byte_range(curves);
  return exact_sizes(curves, looks) +
         fmt::format("set title {} noenhanced\nset xtics ({})\nset xrange [{:.0f}:{:.0f}]\nset yrange {}\nplot {}\n",
                     gnuplot_quoted(model), byte_tics(low, high), low, high, heights(curves),
                     panel_lines(curves, index, looks));
}

// Panels side by side and one key for all of them at the right.
std::string panels_with_key(const std::vector<PlotPanel>& panels, const Looks& looks) {
  const double width = kPanelWidth * static_cast<double>(panels.size()) + kKeyWidth;
  std::string commands = "set multiplot\nunset key\n";
  bool ceilings = false, exact = false;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    commands += fmt::format("set origin {:.5f},0\nset size {:.5f},1\n{}", i * kPanelWidth / width, kPanelWidth / width,
                            panel_commands(panels[i], i, looks));
    for (const CurveSeries& curve : panels[i].second) {
      ceilings = ceilings || drawn_ceiling(curve);
      exact = exact || exact_from(curve);
    }
  }
  std::string entries;
  for (const std::string& name : looks.names())
    entries += fmt::format("{}NaN {} title {}", entries.empty() ? "" : ", ", looks.curve(name), gnuplot_quoted(name));
  if (ceilings) entries += ", NaN with lines dt 2 lw 1 lc rgb '#555555' title 'dashed: remesh (ceiling)'";
  if (exact) entries += ", NaN with lines dt 3 lw 2 lc rgb '#555555' title 'dotted: exact from that size on'";
  // A plot of nothing holds the key.
  return commands +
         fmt::format("set origin {:.5f},0\nset size {:.5f},1\n", 1.0 - kKeyWidth / width, kKeyWidth / width) +
         "unset logscale\nunset border\nunset tics\nunset grid\nunset title\nunset xlabel\nunset ylabel\n"
         "set key center center\nset xrange [0:1]\nset yrange [0:1]\nplot " +
         entries + "\nunset multiplot\n";
}

}  // namespace

std::vector<std::string> method_colors(const std::vector<std::string>& methods) {
  std::vector<std::string> colors;
  std::size_t next = 0;
  for (const std::string& name : methods) {
    // A method with options ("gsp gamma=2") has its method's colour where it is the first of them.
    const std::string method = name.substr(0, name.find(' '));
    const auto known =
        std::find_if(std::begin(kStyles), std::end(kStyles), [&](const Style& s) { return method == s.method; });
    const bool taken =
        known == std::end(kStyles) || std::find(colors.begin(), colors.end(), known->color) != colors.end();
    colors.push_back(taken ? kFurther[next++ % std::size(kFurther)] : known->color);
  }
  return colors;
}

std::string plot_script(const std::string& name, const std::vector<PlotPanel>& panels) {
  std::string data;
  for (std::size_t i = 0; i < panels.size(); ++i) data += panel_data(panels[i].second, i);
  // Set anew for each terminal, since a key of its own changes them.
  const std::string setup =
      "reset\nset logscale x 2\nset grid back lt 1 lw 1 lc rgb '#e4e4e4'\nset key Left reverse noenhanced\n"
      "set xlabel 'bytes'\nset ylabel 'PSNR in dB (diagonal / RMS)'\n";
  const Looks looks(curve_names(panels));
  if (panels.size() > 1)
    return figure_script(name, data, setup + panels_with_key(panels, looks),
                         kPanelWidth * static_cast<int>(panels.size()) + kKeyWidth, 600);
  const bool few = looks.names().size() <= kFewCurves;
  const std::string key = few ? "set key inside bottom right\n" : "set key outside right center\n";
  std::string commands = setup + key;
  for (const PlotPanel& panel : panels) commands += panel_commands(panel, 0, looks);
  return figure_script(name, data, commands, 900, 600);
}

std::vector<std::string> plot(const std::string& folder, const std::string& name,
                              const std::vector<PlotPanel>& panels) {
  return draw_figure(folder, name, plot_script(name, panels));
}

}  // namespace gsp
