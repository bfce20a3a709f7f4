#include "experiments/sweep/task_list.h"

#include <algorithm>
#include <set>

#include "experiments/sweep/plan.h"

namespace gsp {

namespace {

int faces_of(const Plan& plan, const Task& task) {
  for (const StoredModel& model : plan.models)
    if (model.surface_key == task.surface_key) return model.faces;
  return 0;
}

// Cells with the same text are one task. Baselines go with the first map of the method gsp on their base.
std::string group_of(const PlannedCell& cell, const std::string& surface,
                     std::map<std::string, std::string>& first_on_base) {
  const CellOptions& options = cell.options;
  if (!has_map(options)) return surface + ' ' + options_json(options, stages_of(options).front());
  const std::string base = surface + ' ' + base_options_json(options);
  const std::string own = base + ' ' + options_json(options, StageKind::Parameterize);
  if (options.method != method_name(Method::Gsp)) {
    const auto found = first_on_base.find(base);
    return found == first_on_base.end() ? base : found->second;
  }
  first_on_base.emplace(base, own);
  return own;
}

void add_done(Task& task, const PlannedCell& cell, const std::map<std::string, StageResult>& done) {
  for (const auto& [kind, key] : cell.keys)
    if (const auto found = done.find(key); found != done.end()) task.done.insert(*found);
}

}  // namespace

bool settled(const PlannedCell& cell, const std::map<std::string, StageResult>& done) {
  if (cell.keys.empty()) return true;
  for (const auto& [kind, key] : cell.keys) {
    const auto found = done.find(key);
    if (found != done.end() && (kind == StageKind::Measure || found->second.failed())) return true;
  }
  return false;
}

std::vector<Task> outstanding_tasks(const Plan& plan, const std::map<std::string, StageResult>& done) {
  std::vector<Task> tasks;
  std::map<std::string, std::size_t> index;
  std::map<std::string, std::string> first_on_base, surface_of;
  for (const StoredModel& model : plan.models) surface_of[model.name] = model.surface_key;
  // Maps of gsp come first, so that the baselines find theirs.
  for (const bool gsp : {true, false})
    for (const PlannedCell& cell : plan.cells) {
      if ((cell.options.method == method_name(Method::Gsp)) != gsp || settled(cell, done)) continue;
      const std::string& key = surface_of[cell.model];
      const auto [found, added] = index.emplace(group_of(cell, key, first_on_base), tasks.size());
      if (added) tasks.push_back({key, surface_path(key), {}, {}});
      Task& task = tasks[found->second];
      task.cells.push_back(cell);
      add_done(task, cell, done);
    }
  std::stable_sort(tasks.begin(), tasks.end(),
                   [&](const Task& a, const Task& b) { return task_weight(plan, a) > task_weight(plan, b); });
  return tasks;
}

double task_memory_bytes(const Plan& plan, const Task& task) {
  constexpr double kProgram = 100e6, kPerFace = 3000.0;
  return kProgram + kPerFace * faces_of(plan, task);
}

double task_weight(const Plan& plan, const Task& task) {
  // A map costs about ten times as much as coding and measuring it.
  constexpr double kMap = 10.0, kCell = 1.0;
  std::set<std::string> maps;
  for (const PlannedCell& cell : task.cells)
    if (const auto key = cell.keys.find(StageKind::Parameterize);
        key != cell.keys.end() && !task.done.count(key->second))
      maps.insert(key->second);
  return faces_of(plan, task) *
         (kMap * static_cast<double>(maps.size()) + kCell * static_cast<double>(task.cells.size()));
}

}  // namespace gsp
