#include "experiments/store/stored_cell.h"

#include <algorithm>

#include "experiments/cells/models.h"
#include "experiments/curve/stages.h"

namespace gsp {

const char* status_name(CellStatus status) {
  switch (status) {
    case CellStatus::Waiting:
      return "waiting";
    case CellStatus::Done:
      return "done";
    case CellStatus::Failed:
      break;
  }
  return "failed";
}

std::string fixed_stream_role(std::size_t bytes) { return "stream of " + std::to_string(bytes) + " bytes"; }

std::string StoredCell::title() const {
  const int replicate = options.parameterize.replicate;
  return replicate == 0 ? label : label + ", replicate " + std::to_string(replicate);
}

const StageResult* StoredCell::stage(StageKind kind) const {
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const StageResult& s) { return s.kind == kind; });
  return found == stages.end() ? nullptr : &*found;
}

std::optional<double> StoredCell::number(const std::string& name) const {
  for (const StageResult& result : stages)
    if (const auto found = result.numbers.find(name); found != result.numbers.end()) return found->second;
  return std::nullopt;
}

std::string StoredCell::artefact(const std::string& role) const {
  for (const StageResult& result : stages)
    if (const auto found = result.artefacts.find(role); found != result.artefacts.end()) return found->second;
  return {};
}

std::string StoredCell::stream_file(std::size_t bytes) const {
  return artefact(options.mode == StreamMode::Fixed ? fixed_stream_role(bytes) : "stream");
}

std::vector<CurvePoint> StoredCell::points() const {
  const StageResult* measured = stage(StageKind::Measure);
  if (!measured || status != CellStatus::Done) return {};
  RemeshShape shape;
  shape.base_vertices = static_cast<int>(number("base_vertices").value_or(0.0));
  shape.base_faces = static_cast<int>(number("base_faces").value_or(0.0));
  shape.level = static_cast<int>(number("level").value_or(0.0));
  shape.remesh_error = number("remesh_error").value_or(0.0);
  std::vector<CurvePoint> rows = measured->points;
  for (CurvePoint& row : rows) {
    row.model = model;
    row.version = measured->version;
    describe(row, options, shape);
  }
  return rows;
}

std::string in_store(const std::string& folder, const std::string& path) {
  return path.empty() ? path : folder + '/' + path;
}

std::vector<StoredCell> stored_cells(const Plan& plan, const std::map<std::string, StageResult>& results,
                                     const std::string& folder) {
  std::map<std::string, const StoredModel*> models;
  for (const StoredModel& model : plan.models) models[model.name] = &model;
  std::vector<StoredCell> cells;
  for (const PlannedCell& planned : plan.cells) {
    StoredCell& cell = cells.emplace_back();
    cell.position = static_cast<int>(cells.size()) - 1;
    cell.model = planned.model;
    cell.label = planned.label;
    cell.options = planned.options;
    const StoredModel& model = *models[planned.model];
    if (!is_shape(model.source)) cell.surface = model.surface_key;
    cell.cause = model.cause;
    cell.failure = model.failure;
    for (const auto& [kind, key] : planned.keys) {
      const auto found = results.find(key);
      if (found == results.end()) continue;
      StageResult result = found->second;
      for (auto& [role, path] : result.artefacts) path = in_store(folder, path);
      if (cell.cause.empty() && result.failed()) {
        cell.cause = result.cause;
        cell.failure = result.failure;
      }
      cell.stages.push_back(std::move(result));
    }
    if (!cell.cause.empty())
      cell.status = CellStatus::Failed;
    else if (cell.stage(StageKind::Measure))
      cell.status = CellStatus::Done;
  }
  return cells;
}

}  // namespace gsp
