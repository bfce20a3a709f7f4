#include "experiments/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/cells/cell_options.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/curve/summary.h"
#include "experiments/output/decibels.h"
#include "experiments/output/earlier_run.h"
#include "experiments/output/quoting.h"
#include "experiments/play/page_parts.h"
#include "experiments/plot/gnuplot.h"
#include "experiments/report/page.h"
#include "experiments/report/run_figures.h"
#include "experiments/report/view_data.h"
#include "experiments/store/json_file.h"
#include "experiments/version.h"
#include "mesh/atomic_file.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

std::string view_name(std::size_t number) { return fmt::format("views/{}.js", number); }

Json optional(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); }

/// Every text of it as people read it, since names may hold any bytes.
void make_printable(Json& json) {
  if (json.is_string()) json = printable(json.get<std::string>());
  if (json.is_structured())
    for (Json& inside : json) make_printable(inside);
}

// What the page draws of several replicates: their mean, and a band around it.
Json spread_json(const CurveSeries& series) {
  Json points = Json::array();
  for (const SpreadPoint& p : spread_of(series)) {
    Json point = {{"bytes", p.bytes}};
    put_db(point, "psnr_db", p.mean_db);
    point.update({{"low_db", optional(p.lowest_db)}, {"high_db", optional(p.highest_db)}});
    points.push_back(point);
  }
  return points;
}

class Report {
 public:
  Report(const std::string& run_folder, std::string folder, const ReportOptions& options, Progress& progress)
      : run_(read_run(run_folder, options.recipe)), folder_(std::move(folder)), options_(options), progress_(progress) {
    result_.findings = findings(run_);
    make_folder(folder_);
    stems_ = stems_of_earlier_run(folder_);
    for (const StoredModel& model : run_.models) stems_.insert(file_stem(model.name));
  }

  ReportResult make() {
    result_.files.push_back(folder_ + "/index.html");
    write_csv();
    write_views();
    const std::vector<RunFigure> figures =
        options_.figures ? run_figures(run_, result_.findings, folder_, options_.map_models, progress_)
                         : std::vector<RunFigure>();
    for (const RunFigure& figure : figures) {
      result_.files.push_back(folder_ + "/" + figure.png);
      if (!figure.svg.empty()) result_.files.push_back(folder_ + "/" + figure.svg);
    }
    Json run = run_json(figures);
    make_printable(run);
    write_file(result_.files.front(), report_page(run.dump()));
    remove_earlier();
    return std::move(result_);
  }

 private:
  /// After the page, which names none of them any more.
  void remove_earlier() const {
    std::vector<std::string> bases = {"curves", "remesh-error", "discs"}, made = result_.files, stale;
    for (const std::string& stem : stems_)
      for (const char* what : {"curve", "cost", "layout", "distortion", "smoothness"})
        bases.push_back(what + ("-" + stem));
    for (const std::string& base : bases) {
      const std::vector<std::string> files = figure_files("figures/" + base);
      stale.insert(stale.end(), files.begin(), files.end());
      if (std::find(made.begin(), made.end(), folder_ + "/" + files[1]) != made.end())
        made.push_back(folder_ + "/" + files[2]);  // of the drawn ones
    }
    for (std::size_t i = views_.size(); fs::exists(folder_ + "/" + view_name(i)); ++i) stale.push_back(view_name(i));
    remove_stale(folder_, stale, made);
  }

  void write_csv() {
    std::vector<CurvePoint> all;
    for (const StoredCell& cell : run_.cells) {
      const std::vector<CurvePoint> points = cell.points();
      all.insert(all.end(), points.begin(), points.end());
    }
    write_curve_csv(folder_ + "/curve.csv", all);
    result_.files.push_back(folder_ + "/curve.csv");
  }

  /// The cells of a model that the 3D view shows: the reference first.
  std::vector<const StoredCell*> viewed_cells(const StoredModel& model) const {
    std::vector<const StoredCell*> cells;
    std::set<std::string> taken;  // of replicates the first
    for (const StoredCell& cell : run_.cells)
      if (cell.model == model.name && cell.status == CellStatus::Done && !cell.artefact("stream").empty() &&
          taken.insert(cell.label).second)
        cells.push_back(&cell);
    std::stable_partition(cells.begin(), cells.end(),
                          [&](const StoredCell* c) { return c->label == result_.findings.reference; });
    // One of each method before further settings of one.
    std::map<std::string, int> uses;
    std::vector<std::pair<int, const StoredCell*>> order;
    for (const StoredCell* cell : cells) order.emplace_back(uses[cell->options.method]++, cell);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    cells.clear();
    for (const auto& [use, cell] : order)
      if (static_cast<int>(cells.size()) < options_.views) cells.push_back(cell);
    return cells;
  }

  void write_views() {
    const bool streams = has_browser_decoder() && !options_.stored_surfaces;
    for (const StoredModel& model : run_.models) {
      if (model.path.empty()) continue;
      for (const StoredCell* cell : viewed_cells(model)) {
        make_folder(folder_ + "/views");
        const std::string name = view_name(views_.size());
        Progress named = progress_.within(model.name + ", " + cell->label);
        write_file(folder_ + "/" + name,
                   fmt::format("gspView(\"{}\", {});\n", name, view_json(model, *cell, streams, named)));
        views_[{model.name, cell->label}] = name;
        result_.files.push_back(folder_ + "/" + name);
      }
    }
  }

  /// Of the cells that share a label on a model: numbers that have no mean are the first one's.
  Json curve_json(const StoredCell& cell, const CurveSeries* series, const MethodSummary* summary) const {
    Json points = Json::array(), bytes_at = Json::array();
    std::string positions;
    if (series)
      for (const auto& [replicate, run] : series->runs)
        for (const CurvePoint& p : run) {
          positions = further_option(p.options, "positions");
          if (!on_a_curve(p)) continue;
          points.push_back(measured_json(p));
          points.back()["replicate"] = replicate;
        }
    for (std::size_t i = 0; i < std::size(kTableLevelsDb); ++i)
      bytes_at.push_back(summary ? optional(summary->bytes_at[i]) : Json());
    const Comparison* comparison = result_.findings.comparison(cell.model, cell.label);
    const auto view = views_.find({cell.model, cell.label});
    const std::optional<double> ceiling = summary ? summary->ceiling_db : std::nullopt;
    Json curve = {{"label", cell.label},
                  {"method", cell.options.method},
                  {"mode", stream_mode_name(cell.options.mode)},
                  {"replicates", series ? series->runs.size() : 0}};
    put_db(curve, "ceiling_db", ceiling);
    curve.update(
        {{"base_vertices", optional(cell.number("base_vertices"))},
         {"level", optional(cell.number("level"))},
         {"positions", positions.empty() ? Json() : Json(positions)},
         {"remesh_error", ceiling ? Json(std::pow(10.0, -*ceiling / 20.0)) : Json()},
         {"paper_error", !has_remesh(cell.options) ? Json() : optional(run_.paper_error(cell.model))},
         {"bytes_at", bytes_at},
         {"bd_rate", comparison ? optional(comparison->bd_rate) : Json()},
         {"bd_interval",
          comparison && comparison->interval ? Json{comparison->interval->low, comparison->interval->high} : Json()},
         {"bd_note", comparison ? comparison->note : ""},
         {"view", view == views_.end() ? Json() : Json(view->second)},
         {"spread", series && series->runs.size() > 1 ? spread_json(*series) : Json()},
         {"points", points}});
    return curve;
  }

  Json model_json(const StoredModel& model) const {
    const std::vector<CurveSeries> series = run_.curves(model.name);
    const CurveSummary summary = summarize(model.name, series);
    Json curves = Json::array();
    std::set<std::string> told;
    for (const StoredCell& cell : run_.cells) {
      if (cell.model != model.name || !told.insert(cell.label).second) continue;
      // Summaries are in the order of the series.
      const auto found =
          std::find_if(series.begin(), series.end(), [&](const CurveSeries& s) { return s.name == cell.label; });
      const bool known = found != series.end();
      curves.push_back(
          curve_json(cell, known ? &*found : nullptr,
                     known ? &summary.methods[static_cast<std::size_t>(found - series.begin())] : nullptr));
    }
    return {{"name", model.name}, {"vertices", model.vertices}, {"faces", model.faces}, {"curves", curves}};
  }

  Json run_json(const std::vector<RunFigure>& figures) const {
    Json models = Json::array(), failures = Json::array(), pictures = Json::array();
    for (const StoredModel& model : run_.models) models.push_back(model_json(model));
    for (const StoredCell& cell : run_.cells)
      if (cell.status == CellStatus::Failed)
        failures.push_back(
            {{"model", cell.model}, {"label", cell.title()}, {"cause", cell.cause}, {"failure", cell.failure}});
    for (const RunFigure& f : figures) pictures.push_back({{"png", f.png}, {"svg", f.svg}, {"caption", f.caption}});
    return {{"name", run_.name},
            {"about", fmt::format("{} model{}, {} cells, gsp {}", run_.models.size(),
                                  run_.models.size() == 1 ? "" : "s", run_.cells.size(), version())},
            {"reference", result_.findings.reference},
            {"sentences", result_.findings.sentences},
            {"levels_db", kTableLevelsDb},
            {"models", models},
            {"failures", failures},
            {"figures", pictures}};
  }

  Run run_;
  std::string folder_;
  const ReportOptions& options_;
  Progress& progress_;
  ReportResult result_;
  std::set<std::string> stems_;  ///< file names of this run's surfaces, and of an earlier one's in the folder
  std::map<std::pair<std::string, std::string>, std::string> views_;  ///< file by model and label
};

}  // namespace

ReportResult make_report(const std::string& run_folder, const std::string& folder, const ReportOptions& options,
                         Progress& progress) {
  return Report(run_folder, folder, options, progress).make();
}

}  // namespace gsp
