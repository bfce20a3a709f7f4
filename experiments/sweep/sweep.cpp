#include "experiments/sweep/sweep.h"

#include <algorithm>
#include <filesystem>

#include "experiments/curve/curve_csv.h"
#include "experiments/store/artefacts.h"
#include "experiments/store/folder_lock.h"
#include "experiments/sweep/inbox.h"
#include "experiments/sweep/plan.h"
#include "experiments/sweep/slurm.h"
#include "experiments/sweep/worker_pool.h"
#include "mesh/atomic_file.h"
#include "mesh/io.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

// Failures that say nothing about the cell go away, and all of the plan's where that is asked for.
void forget_failures(Store& store, const Plan& plan, bool all) {
  const std::map<std::string, StageResult> results = store.results();
  std::vector<std::string> keys;
  for (const PlannedCell& cell : plan.cells)
    for (const auto& [kind, key] : cell.keys) {
      const auto found = results.find(key);
      if (found == results.end() || !found->second.failed()) continue;
      const std::string& cause = found->second.cause;
      if (all || cause == "killed" || cause == "crashed" || cause == "out-of-memory") keys.push_back(key);
    }
  store.erase(keys);
}

void keep_surface(const std::string& folder, const std::string& key, const Mesh& mesh) {
  const std::string path = folder + '/' + surface_path(key);
  if (fs::exists(path)) return;
  make_folder(fs::path(path).parent_path().string());
  write_mesh(path, mesh);
}

}  // namespace

bool SweepResult::failed() const {
  return std::any_of(cells.begin(), cells.end(), [](const StoredCell& c) { return c.status == CellStatus::Failed; });
}

SweepResult sweep(const Recipe& recipe, const std::string& folder, const SweepOptions& options, Progress& progress) {
  make_folder(folder);
  const FolderLock lock(folder);  // before the database, which two sweeps would make at once
  Store store = Store::create(folder);
  const SlurmState slurm = slurm_state(folder);
  if (slurm.active() && !options.slurm)
    throw Error(Cause::CannotWrite, "Slurm job " + slurm.job + " is at work on " + folder);
  if (!slurm.active()) remove_unfinished(folder);
  const Plan plan =
      make_plan(recipe, [&](const std::string& key, const Mesh& mesh) { keep_surface(folder, key, mesh); });
  for (const std::string& note : plan.notes) progress.note(note);
  store.replace_plan(plan);
  empty_inbox(store);
  if (!slurm.active()) forget_failures(store, plan, options.retry_failed);
  SweepResult result;
  result.stages_run =
      options.slurm ? run_on_slurm(plan, store, options, progress) : run_in_workers(plan, store, options, progress);
  result.cells = store.cells(recipe.name);
  write_curve_csv(folder + "/curve.csv", points_of(result.cells));
  return result;
}

std::vector<StoredCell> planned_cells(const Recipe& recipe, const std::string& folder) {
  const Plan plan = make_plan(recipe, [](const std::string&, const Mesh&) {});
  std::map<std::string, StageResult> known;
  if (fs::exists(folder + "/results.sqlite")) known = Store::open(folder).results();
  return stored_cells(plan, known, folder);
}

bool sweep_at_work(const std::string& folder) { return FolderLock::held(folder); }

std::vector<CurveSummary> summaries_of(const std::vector<StoredCell>& cells) {
  std::vector<CurveSummary> summaries;
  for (std::size_t first = 0, next; first < cells.size(); first = next) {
    std::vector<CurveSeries> curves;
    CurveSummary failed;
    for (next = first; next < cells.size() && cells[next].model == cells[first].model; ++next) {
      add_run(curves, cells[next].label, cells[next].options.parameterize.replicate, cells[next].points());
      if (!failed.cause.empty() || cells[next].cause.empty()) continue;
      failed.cause = cells[next].cause;
      failed.failure = cells[next].title() + ": " + cells[next].failure;
    }
    CurveSummary& summary = summaries.emplace_back(summarize(cells[first].model, curves));
    summary.cause = failed.cause;
    summary.failure = failed.failure;
  }
  return summaries;
}

std::vector<CurvePoint> points_of(const std::vector<StoredCell>& cells) {
  std::vector<CurvePoint> all;
  for (const StoredCell& cell : cells) {
    const std::vector<CurvePoint> points = cell.points();
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

}  // namespace gsp
