#include "experiments/report/run_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiments/output/quoting.h"
#include "experiments/plot/plot.h"
#include "experiments/report/cost.h"

namespace gsp {

namespace {

constexpr std::size_t kMostPanels = 4;
/// More bars a group than a reader can tell apart; a table has them.
constexpr std::size_t kMostBars = 12;
/// Pixels of a figure of bars with its key at the right.
constexpr int kBarsWidth = 1200;
constexpr const char* kGrid = "set grid ytics back lt 1 lw 1 lc rgb '#e4e4e4'\n";

/// `like_last`: of the same kind as the one before.
void add_figure(RunPlots& plots, const std::string& name, const std::string& script, const std::string& caption,
                bool like_last = false) {
  constexpr std::size_t kFiguresARun = 50;  // 2 s, after which a run can be cancelled
  if (!like_last || plots.runs.back().size() >= kFiguresARun) plots.runs.emplace_back();
  plots.runs.back().push_back({name, script});
  plots.figures.push_back({"figures/" + name + ".png", "figures/" + name + ".svg", caption});
}

std::string value_or_missing(const std::optional<double>& value, double scale = 1.0) {
  return value ? fmt::format("{:.6g}", scale * *value) : "NaN";
}

/// What makes groups of bars: a row a model, a column a label.
std::string bars(const std::string& rows) {
  const auto groups = std::count(rows.begin(), rows.end(), '\n');
  return fmt::format("set xrange [-0.6:{}.6]\n$bars << EOD\n{}EOD\n", groups - 1, rows) +
         "set style data histogram\nset style histogram cluster gap 1\nset style fill solid border rgb 'white'\n" +
         "set key outside right center Left reverse noenhanced\n" + kGrid + "set xtics scale 0 noenhanced\n";
}

/// The command that draws them.
std::string plot_bars(const std::vector<std::string>& labels, const std::vector<std::string>& colors) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < labels.size(); ++i)
    command += fmt::format("{}$bars using {}:xtic(1) lc rgb '{}' title {}", i ? ", " : "", i + 2, colors[i],
                           gnuplot_quoted(labels[i]));
  return command + '\n';
}

/// The colours that labels have in the curves of the same run.
std::vector<std::string> curve_colors(const Run& run, const std::vector<std::string>& labels) {
  const std::vector<std::string> all = run.labels(), colors = method_colors(all);
  std::vector<std::string> chosen;
  for (const std::string& label : labels)
    chosen.push_back(colors[static_cast<std::size_t>(std::find(all.begin(), all.end(), label) - all.begin())]);
  return chosen;
}

bool has_map(const StoredCell& cell) {
  return cell.status == CellStatus::Done && cell.number("remesh_error").has_value();
}

/// Over the replicates; empty where none has a map.
std::optional<double> mean_remesh_error(const Run& run, const std::string& model, const std::string& label) {
  double sum = 0.0;
  int count = 0;
  for (const StoredCell& cell : run.cells)
    if (cell.model == model && cell.label == label && has_map(cell)) sum += *cell.number("remesh_error"), ++count;
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// The two numeric options that vary within a model for the method; fewer or more than two where there is no such pair.
std::vector<const Axis*> varying_numbers(const Run& run, const std::string& method) {
  std::vector<const Axis*> varying;
  for (const Axis& axis : axes()) {
    if (axis.kind == Axis::Kind::Word || axis.repeats) continue;
    std::map<std::string, std::set<std::string>> values;
    for (const StoredCell& cell : run.cells)
      if (cell.options.method == method) values[cell.model].insert(to_string(axis.get(cell.options)));
    if (std::any_of(values.begin(), values.end(), [](const auto& v) { return v.second.size() > 1; }))
      varying.push_back(&axis);
  }
  return varying;
}

double number_of(const AxisValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return -1.0;  // "auto", before all numbers
}

/// The values of an option over a sweep, ascending, and where each stands.
class Scale {
 public:
  Scale(const Run& run, const std::string& method, const Axis& axis) : axis_(axis) {
    std::map<double, std::string> texts;
    for (const StoredCell& cell : run.cells)
      if (cell.options.method == method) texts[number_of(axis.get(cell.options))] = to_string(axis.get(cell.options));
    for (const auto& [number, text] : texts) texts_.push_back(text);
  }
  std::size_t place(const StoredCell& cell) const {
    const std::string text = to_string(axis_.get(cell.options));
    return static_cast<std::size_t>(std::find(texts_.begin(), texts_.end(), text) - texts_.begin());
  }
  std::string tics() const {
    std::string tics;
    for (std::size_t i = 0; i < texts_.size(); ++i) tics += fmt::format("{}'{}' {}", i ? ", " : "", texts_[i], i);
    return tics;
  }
  std::size_t size() const { return texts_.size(); }
  const char* name() const { return axis_.name; }

 private:
  const Axis& axis_;
  std::vector<std::string> texts_;
};

/// One panel of a heat map: rows "x y value text" by the cells of one method. `value` gives that of a label.
template <class Value>
std::string heat_rows(const Run& run, const std::string& method, const Scale& x, const Scale& y, const Value& value) {
  std::map<std::pair<std::size_t, std::size_t>, std::string> rows;
  for (const StoredCell& cell : run.cells) {
    if (cell.options.method != method || cell.options.parameterize.replicate > 0) continue;
    const std::optional<double> v = value(cell.label);
    rows[{y.place(cell), x.place(cell)}] =
        value_or_missing(v) + ' ' + (v ? fmt::format("{:+.1f}", *v) : std::string("–"));
  }
  std::string text;
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto row = rows.find({j, i});
      text += fmt::format("{} {} {}\n", i, j, row == rows.end() ? "NaN –" : row->second);
    }
  return text;
}

}  // namespace

void curve_figures(const Run& run, RunPlots& plots) {
  std::vector<PlotPanel> panels;
  for (const StoredModel& model : run.models) {
    std::vector<CurveSeries> curves = run.curves(model.name);
    if (curves.empty()) continue;
    const std::string name = "curve-" + file_stem(model.name);
    add_figure(plots, name, plot_script(name, {{model.name, curves}}),
               "Rate-distortion curves of " + model.name + ", ceilings dashed (the paper's figure 7).",
               !panels.empty());
    panels.emplace_back(model.name, std::move(curves));
  }
  if (panels.size() < 2 || panels.size() > kMostPanels) return;
  add_figure(plots, "curves", plot_script("curves", panels), "Rate-distortion curves (the paper's figure 7).");
}

void bar_figure(const Run& run, const Findings& found, RunPlots& plots) {
  std::vector<std::string> labels;
  for (const Comparison& c : found.comparisons)
    if (c.bd_rate && std::find(labels.begin(), labels.end(), c.label) == labels.end()) labels.push_back(c.label);
  if (labels.empty() || labels.size() > kMostBars) return;
  std::string rows;
  for (const StoredModel& model : run.models) {
    rows += gnuplot_field(model.name);
    for (const std::string& label : labels) {
      const Comparison* c = found.comparison(model.name, label);
      rows += ' ' + value_or_missing(c ? c->bd_rate : std::nullopt);
    }
    rows += '\n';
  }
  const std::string setup =
      bars(rows) + "set datafile separator whitespace\nset ylabel 'bytes over those of the reference, %'\nset title " +
      gnuplot_quoted("reference: " + found.reference) +
      " noenhanced\n"
      "set xzeroaxis lt 1 lc rgb '#555555'\nset yrange [*<0:0<*]\n";
  add_figure(plots, "bd-rate",
             figure_script("bd-rate", setup, plot_bars(labels, curve_colors(run, labels)), kBarsWidth, 500),
             fmt::format("BD-rate against {}: bytes that each needs more at equal PSNR, ceilings respected.",
                         found.reference));
}

void heat_figure(const Run& run, const Findings& found, RunPlots& plots) {
  const auto reference =
      std::find_if(run.cells.begin(), run.cells.end(), [&](const StoredCell& c) { return c.label == found.reference; });
  if (reference == run.cells.end()) return;
  const std::string& method = reference->options.method;
  const std::vector<const Axis*> varying = varying_numbers(run, method);
  if (varying.size() != 2) return;
  const Scale x(run, method, *varying[0]), y(run, method, *varying[1]);

  std::vector<std::pair<std::string, std::string>> panels;
  panels.emplace_back("mean of the models", heat_rows(run, method, x, y, [&](const std::string& label) {
                        if (label == found.reference) return std::optional(0.0);
                        const auto mean = found.mean(label);
                        return mean ? std::optional(mean->bd_rate) : std::nullopt;
                      }));
  for (const StoredModel& model : run.models)
    if (panels.size() <= kMostPanels)
      panels.emplace_back(model.name, heat_rows(run, method, x, y, [&](const std::string& label) {
                            const Comparison* c = found.comparison(model.name, label);
                            if (label == found.reference) return std::optional(0.0);
                            return c ? c->bd_rate : std::nullopt;
                          }));

  std::string setup = fmt::format(
      "set xtics ({}) scale 0\nset ytics ({}) scale 0\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
      "set xrange [-0.5:{}.5]\n"
      "set yrange [-0.5:{}.5]\nset cbrange [-25:25]\nunset key\n"
      "set palette defined (-25 '#2166ac', 0 '#f7f7f7', 25 '#b2182b')\nset size square\n",
      x.tics(), y.tics(), gnuplot_quoted(x.name()), gnuplot_quoted(y.name()), x.size() - 1, y.size() - 1);
  std::string commands = fmt::format("set multiplot layout 1,{} title {} noenhanced\n", panels.size(),
                                     gnuplot_quoted("bytes over those of " + found.reference + ", %"));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    setup += fmt::format("$heat{} << EOD\n{}EOD\n", i, panels[i].second);
    commands +=
        fmt::format("set title {} noenhanced\nplot $heat{} using 1:2:3 with image, '' using 1:2:4 with labels\n",
                    gnuplot_quoted(panels[i].first), i);
  }
  add_figure(
      plots, "settings",
      figure_script("settings", setup, commands + "unset multiplot\n", 460 * static_cast<int>(panels.size()), 430),
      fmt::format("BD-rate over {} and {} against {}: blue needs fewer bytes, red more.", x.name(), y.name(),
                  found.reference));
}

void cost_figures(const Run& run, const Findings& found, RunPlots& plots) {
  bool any = false;
  for (const StoredModel& model : run.models) {
    const auto cell = std::find_if(run.cells.begin(), run.cells.end(), [&](const StoredCell& c) {
      return c.model == model.name && c.label == found.reference && !c.artefact("omega").empty();
    });
    if (cell == run.cells.end()) continue;
    const CostCurve cost = cost_curve(read_omega_csv(cell->artefact("omega")));
    if (cost.bins.empty()) continue;
    const std::string name = "cost-" + file_stem(model.name);
    add_figure(
        plots, name, cost_script(name, model.name, cost),
        fmt::format("Cost of vertex removals on {}, the paper's figure 5d: {}.", model.name, cost_in_words(cost)),
        std::exchange(any, true));
  }
}

void error_figure(const Run& run, RunPlots& plots) {
  std::vector<std::string> labels;
  for (const StoredCell& cell : run.cells)
    if (has_map(cell) && std::find(labels.begin(), labels.end(), cell.label) == labels.end())
      labels.push_back(cell.label);
  if (labels.empty() || labels.size() > kMostBars) return;
  bool paper = false;
  std::string rows;
  for (const StoredModel& model : run.models) {
    rows += gnuplot_field(model.name);
    for (const std::string& label : labels) {
      rows += ' ' + value_or_missing(mean_remesh_error(run, model.name, label), 1e5);
    }
    const auto published = run.paper_error(model.name);
    paper = paper || published;
    rows += ' ' + value_or_missing(published, 1e5) + '\n';
  }
  std::vector<std::string> colors = curve_colors(run, labels);
  if (paper) {
    labels.push_back("paper, Table 1");
    colors.push_back("#d8a200");
  }
  const std::string setup = bars(rows) + "set ylabel 'remeshing error, 10^{-5} of the diagonal'\nset yrange [0:*]\n";
  add_figure(plots, "remesh-error", figure_script("remesh-error", setup, plot_bars(labels, colors), kBarsWidth, 500),
             "RMS distance of the uncoded remesh (the paper's Table 1); the level of the remesh decides it as much as "
             "the map.");
}

}  // namespace gsp
