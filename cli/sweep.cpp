#include "experiments/sweep/sweep.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/summary_report.h"
#include "experiments/output/quoting.h"
#include "experiments/sweep/slurm.h"
#include "experiments/sweep/stage_runner.h"
#include "experiments/sweep/worker.h"

namespace gsp::cli {

namespace {

struct SweepArguments {
  std::string recipe, store;
  std::vector<std::string> models;
  int replicates = 0;
  bool dry_run = false, status = false;
  SweepOptions sweep;
};

struct WorkerOptions {
  std::string store, task;
  int parent = 0;
};

Json cell_report(const StoredCell& cell) {
  Json report = {{"model", cell.model},
                 {"cell", cell.label},
                 {"replicate", cell.options.parameterize.replicate},
                 {"status", status_name(cell.status)}};
  Json stages = Json::array();
  for (const StageResult& stage : cell.stages) stages.push_back(stage_name(stage.kind));
  if (cell.status == CellStatus::Waiting) report["done_stages"] = stages;
  if (cell.status == CellStatus::Failed) report.update({{"cause", cell.cause}, {"message", cell.failure}});
  return report;
}

void print_cell(std::ostream& out, const StoredCell& cell) {
  std::string remark;
  if (cell.status == CellStatus::Failed) remark = fmt::format("({}): {}", cell.cause, cell.failure);
  if (cell.status == CellStatus::Waiting)
    for (const StageResult& stage : cell.stages)
      remark += fmt::format("{}{} done", remark.empty() ? "" : ", ", stage_name(stage.kind));
  out << printable(fmt::format("{:<8} {:<16} {} {}", status_name(cell.status), cell.model, cell.title(), remark))
      << '\n';
}

void print_cells(Context& context, const std::vector<StoredCell>& cells, const Json& further) {
  std::map<CellStatus, int> counts{{CellStatus::Waiting, 0}, {CellStatus::Done, 0}, {CellStatus::Failed, 0}};
  for (const StoredCell& cell : cells) ++counts[cell.status];
  if (context.json) {
    Json report = {{"cells", Json::array()}};
    for (const StoredCell& cell : cells) report["cells"].push_back(cell_report(cell));
    for (const auto& [status, count] : counts) report[status_name(status)] = count;
    report.update(further);
    return print_report(context, report);
  }
  for (const StoredCell& cell : cells) print_cell(context.out, cell);
  context.out << fmt::format("{} cells: {} done, {} failed, {} waiting\n", cells.size(), counts[CellStatus::Done],
                             counts[CellStatus::Failed], counts[CellStatus::Waiting]);
  if (!further.empty()) print_text(context.out, further);
}

int run_sweep(SweepArguments& options, Context& context) {
  const Recipe recipe = read_recipe(
      options.recipe, {options.models, options.replicates > 0 ? std::optional(options.replicates) : std::nullopt});
  if (options.dry_run || options.status) {
    Json further = Json::object();
    if (options.status) {
      further["sweep_at_work"] = sweep_at_work(options.store);
      const SlurmState slurm = slurm_state(options.store);
      if (!slurm.job.empty())
        further["slurm"] = {{"job", slurm.job}, {"running", slurm.running}, {"pending", slurm.pending}};
    }
    print_cells(context, planned_cells(recipe, options.store), further);
    return 0;
  }
  Progress progress = context.console.progress();
  options.sweep.program = std::filesystem::read_symlink("/proc/self/exe").string();
  const SweepResult result = sweep(recipe, options.store, options.sweep, progress);
  const std::vector<CurveSummary> summaries = summaries_of(result.cells);
  Json further = {{"stages_run", result.stages_run}, {"table", options.store + "/curve.csv"}};
  if (context.json)
    further.update({{"models", summaries_report(summaries)}, {"means", means_report(summaries)}});
  else
    print_summaries(context.out, summaries);
  print_cells(context, result.cells, further);
  return result.failed() ? 1 : 0;
}

// One line a message, as the sweep that started it reads them.
int run_worker(const WorkerOptions& options, Context& context) {
  if (options.parent > 0) end_with_parent(options.parent);
  const auto say = [&](const std::string& line) { context.out << line << std::endl; };
  Progress progress([&](const std::string& stage, double) {
    say("doing " + stage);
    return !interrupted();
  });
  run_task(
      options.store, read_task(options.task), [&](const std::string& key) { say("begin " + key); }, progress);
  return 0;
}

}  // namespace

void add_sweep(CLI::App& app, Context& context) {
  Command command(app, context, "sweep", "run all cells of a recipe, resuming what an earlier run left");
  auto options = std::make_shared<SweepArguments>();
  constexpr int kMostJobs = 1024;
  command.argument("RECIPE", options->recipe,
                   "what to vary, TOML (experiments/recipes has some; [[external]] runs others' programs)");
  command.output_folder("--store", options->store, true, "folder for the results");
  command.texts("--models", options->models, "PATTERN...",
                "surfaces instead of the recipe's; one called as a model with keys of its own keeps them");
  command.integer("--replicates", options->replicates, 0, kMostReplicates,
                  "of each cell, to learn what chance does; 0 for as many as the recipe says");
  command.integer("--jobs", options->sweep.jobs, 0, kMostJobs,
                  "worker processes, 0 for one a core; fewer run where memory is short");
  command.flag("--slurm", options->sweep.slurm, "as a Slurm job array; called again, it waits for the one under way");
  command.flag("--dry-run", options->dry_run, "list the cells and what is done of them; change nothing");
  command.flag("--status", options->status, "the same, and what is at work here and in Slurm");
  command.flag("--fail-fast", options->sweep.fail_fast, "stop at the first cell that fails");
  command.flag("--retry-failed", options->sweep.retry_failed, "run failed cells again");
  command.exclude("--dry-run", "--status");
  command.on_run([options, &context] { return run_sweep(*options, context); });
}

void add_sweep_worker(CLI::App& app, Context& context) {
  Command command(app, context, "sweep-worker", "run one task of a sweep; sweeps start it themselves");
  command.hide();
  auto options = std::make_shared<WorkerOptions>();
  command.required_option("--store", "DIR", options->store, "the sweep's folder");
  command.required_option("--task", "FILE", options->task, "the task");
  command.integer("--parent", options->parent, 0, std::numeric_limits<int>::max(), "process to end with, 0 for none");
  command.on_run([options, &context] { return run_worker(*options, context); });
}

}  // namespace gsp::cli
