#include "experiments/report/run.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "experiments/cells/cell_options.h"
#include "experiments/curve/curve_csv.h"
#include "experiments/output/quoting.h"
#include "experiments/report/paper.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

StageResult remesh_stage(const CurvePoint& point) {
  StageResult stage;
  stage.kind = StageKind::Remesh;
  stage.numbers = {{"base_vertices", point.base_vertices},
                   {"base_faces", point.base_faces},
                   {"level", point.level},
                   {"remesh_error", point.remesh_error}};
  return stage;
}

/// A cell of one curve of a curve.csv, from its first row.
StoredCell first_of(const CurvePoint& point, const fs::path& folder) {
  StoredCell cell;
  cell.model = point.model;
  cell.label = curve_name(point);
  cell.options.method = point.method;
  cell.options.parameterize.gamma = point.gamma;
  cell.options.parameterize.mu = point.mu;
  cell.options.parameterize.replicate = point.replicate;
  const std::string positions = further_option(point.options, "positions");
  for (Positions p : kPositions)
    if (positions == positions_name(p)) cell.options.remesh.positions = p;
  const std::string kind = further_option(point.options, "kind");
  for (RemeshKind k : kRemeshKinds)
    if (kind == remesh_kind_name(k)) cell.options.remesh.kind = k;
  if (point.coder == coder_name(StreamMode::Fixed)) cell.options.mode = StreamMode::Fixed;
  cell.status = CellStatus::Done;
  if (ceiling_db({point})) {
    StageResult map;
    map.kind = StageKind::Parameterize;
    const fs::path omega = folder / (file_stem(point.model) + "-omega.csv");
    if (fs::exists(omega)) map.artefacts["omega"] = omega.string();
    cell.stages.push_back(map);
    cell.stages.push_back(remesh_stage(point));
  }
  StageResult measure;
  measure.kind = StageKind::Measure;
  cell.stages.push_back(measure);
  return cell;
}

Run read_curve_folder(const fs::path& folder) {
  Run run;
  run.name = fs::weakly_canonical(folder).filename().string();
  for (CurvePoint& point : read_curve_csv((folder / "curve.csv").string())) {
    const std::string label = curve_name(point);
    if (!run.model(point.model)) {
      StoredModel& model = run.models.emplace_back();
      model.name = point.model;
    }
    const auto same = [&](const StoredCell& c) {
      return c.model == point.model && c.label == label && c.options.parameterize.replicate == point.replicate;
    };
    auto cell = std::find_if(run.cells.begin(), run.cells.end(), same);
    if (cell == run.cells.end()) cell = run.cells.insert(run.cells.end(), first_of(point, folder));
    cell->stages.back().points.push_back(std::move(point));
  }
  return run;
}

using Varying = std::map<std::string, std::set<std::string>>;  // names of axes by method

/// The axes that vary between the cells of one method on one model. What varies between models only, such as the size
/// of the base, is no other setting.
Varying varying_axes(const std::vector<StoredCell>& cells) {
  std::map<std::pair<std::string, std::string>, const StoredCell*> first;
  Varying varying;
  for (const StoredCell& cell : cells) {
    const StoredCell* other = first.try_emplace({cell.model, cell.options.method}, &cell).first->second;
    for (const Axis& axis : axes())
      if (!axis.repeats && axis.get(cell.options) != axis.get(other->options))
        varying[cell.options.method].insert(axis.name);
  }
  return varying;
}

/// Labels by what varies within a model, so that one setting has one label on all models. Where that would not tell two
/// cells of a model apart, labels stay the store's.
void relabel(std::vector<StoredCell>& cells) {
  Varying varying = varying_axes(cells);
  std::vector<std::string> labels;
  std::set<std::tuple<std::string, std::string, int>> taken;
  for (const StoredCell& cell : cells) {
    std::string& label = labels.emplace_back(cell.options.method);
    for (const Axis& axis : axes())
      if (varying[cell.options.method].contains(axis.name))
        label += ' ' + std::string(axis.name) + '=' + to_string(axis.get(cell.options));
    if (!taken.emplace(cell.model, label, cell.options.parameterize.replicate).second) return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i].label = labels[i];
}

}  // namespace

const StoredModel* Run::model(const std::string& wanted) const {
  const auto found = std::find_if(models.begin(), models.end(), [&](const StoredModel& m) { return m.name == wanted; });
  return found == models.end() ? nullptr : &*found;
}

std::optional<double> Run::paper_error(const std::string& wanted) const {
  const auto found = paper_errors.find(wanted);
  return found == paper_errors.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> Run::labels() const {
  std::vector<std::string> labels;
  for (const StoredCell& cell : cells)
    if (std::find(labels.begin(), labels.end(), cell.label) == labels.end()) labels.push_back(cell.label);
  return labels;
}

std::vector<CurveSeries> Run::curves(const std::string& wanted) const {
  std::vector<CurveSeries> curves;
  for (const StoredCell& cell : cells) {
    if (cell.model == wanted) add_run(curves, cell.label, cell.options.parameterize.replicate, cell.points());
  }
  return curves;
}

Run read_run(const std::string& folder, const std::string& recipe) {
  if (fs::exists(fs::path(folder) / "results.sqlite")) {
    const Store store = Store::open(folder);
    Run run;
    const std::vector<std::string> recipes = store.recipes();
    run.name = !recipe.empty() ? recipe : recipes.empty() ? "empty" : recipes.front();
    run.models = store.models(recipe);
    run.cells = store.cells(recipe);
    relabel(run.cells);
    for (const StoredModel& model : run.models)
      if (const auto error = paper_remesh_error(model)) run.paper_errors[model.name] = *error;
    return run;
  }
  if (!fs::exists(fs::path(folder) / "curve.csv"))
    throw Error(Cause::CannotOpen, folder + " holds neither results.sqlite of gsp sweep nor curve.csv of gsp curve");
  return read_curve_folder(folder);
}

}  // namespace gsp
