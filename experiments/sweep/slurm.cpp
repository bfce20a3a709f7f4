#include "experiments/sweep/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "experiments/output/quoting.h"
#include "experiments/sweep/inbox.h"
#include "experiments/sweep/task_list.h"
#include "experiments/sweep/worker.h"
#include "mesh/atomic_file.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

// Slurm's own limit on the size of an array is 1001 unless it is configured otherwise.
constexpr std::size_t kMostArrayTasks = 1000;
constexpr auto kPause = std::chrono::milliseconds(500);
constexpr int kPausesBetweenQueries = 4;

std::string slurm_folder(const std::string& store) { return store + "/slurm"; }
std::string job_file(const std::string& store) { return slurm_folder(store) + "/job"; }

// What a command prints. Throws where it fails.
std::vector<std::string> output_of(const std::string& program, const std::vector<std::string>& arguments) {
  Worker command(program, arguments);
  std::vector<std::string> lines;
  while (!command.ended())
    for (std::string& line : command.read_lines()) lines.push_back(std::move(line));
  const WorkerEnd end = command.wait();
  if (end.status != 0 || end.signal != 0)
    throw Error(Cause::ToolMissing, fmt::format("{} failed with status {}", program, end.status));
  return lines;
}

// Array task k does the tasks k, k + width, k + 2 width and so on, so any number of them fits into one array. It runs
// in the store's folder (sbatch --chdir), whose name an #SBATCH line could not quote, so that no name of it stands
// here.
std::string array_script(const std::string& program, std::size_t tasks, std::size_t width) {
  return fmt::format(
      "#!/bin/sh\n#SBATCH --job-name=gsp-sweep\n#SBATCH --array=0-{}\n#SBATCH --output=slurm/%a.log\n"
      "task=$SLURM_ARRAY_TASK_ID\nwhile [ \"$task\" -lt {} ]; do\n"
      "  {} sweep-worker --store . --task \"slurm/$task.json\" --threads \"${{SLURM_CPUS_PER_TASK:-1}}\"\n"
      "  task=$((task + {}))\ndone\n",
      width - 1, tasks, shell_word(program), width);
}

void submit(const std::vector<Task>& tasks, const std::string& folder, const std::string& program) {
  fs::remove_all(slurm_folder(folder));
  make_folder(slurm_folder(folder));
  for (std::size_t i = 0; i < tasks.size(); ++i)
    write_task(fmt::format("{}/{}.json", slurm_folder(folder), i), tasks[i]);
  const std::string script = slurm_folder(folder) + "/array.sh";
  write_file(script, array_script(program, tasks.size(), std::min(tasks.size(), kMostArrayTasks)));
  const std::vector<std::string> printed = output_of("sbatch", {"--parsable", "--chdir=" + folder, script});
  if (printed.empty()) throw Error(Cause::ToolMissing, "sbatch named no job");
  // On a federation the cluster's name follows.
  write_file(job_file(folder), printed.back().substr(0, printed.back().find(';')) + "\n");
}

}  // namespace

SlurmState slurm_state(const std::string& folder) {
  SlurmState state;
  if (!fs::exists(job_file(folder))) return state;
  state.job = read_file(job_file(folder));
  state.job.erase(state.job.find_last_not_of('\n') + 1);
  // squeue fails on a job that it has forgotten, so it is asked for all of this user's.
  for (const std::string& line : output_of("squeue", {"--me", "--array", "--noheader", "--format=%F %t"})) {
    const std::size_t space = line.find(' ');
    if (line.substr(0, space) != state.job) continue;
    ++(line.compare(space + 1, 2, "PD") == 0 ? state.pending : state.running);
  }
  return state;
}

int run_on_slurm(const Plan& plan, Store& store, const SweepOptions& options, Progress& progress) {
  const std::string folder = fs::absolute(store.folder()).lexically_normal().string();
  SlurmState state = slurm_state(folder);
  if (!state.active()) {
    const std::vector<Task> tasks = outstanding_tasks(plan, store.results());
    if (tasks.empty()) return 0;
    submit(tasks, folder, options.program);
    state = slurm_state(folder);
    progress.note(fmt::format("Slurm job {}: {} tasks", state.job, tasks.size()));
  }
  const int tasks = std::max(1, state.pending + state.running);
  int stages = 0;
  while (state.active()) {
    progress.report(fmt::format("Slurm job {}: {} running, {} pending", state.job, state.running, state.pending),
                    1.0 - static_cast<double>(state.pending + state.running) / tasks);
    for (int pause = 0; pause < kPausesBetweenQueries; ++pause) std::this_thread::sleep_for(kPause);
    stages += static_cast<int>(empty_inbox(store).size());
    state = slurm_state(folder);
  }
  // Network file systems show a file a moment after it was renamed.
  std::this_thread::sleep_for(kPause);
  return stages + static_cast<int>(empty_inbox(store).size());
}

}  // namespace gsp
