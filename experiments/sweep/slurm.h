#pragma once

#include <string>

#include "experiments/sweep/sweep.h"

namespace gsp {

/// What Slurm still has to do for a store.
struct SlurmState {
  std::string job;               ///< id of the last array job, empty where there was none
  int pending = 0, running = 0;  ///< its array tasks
  bool active() const { return pending + running > 0; }
};

/// By squeue; nothing where no job was ever submitted. Throws Error(ToolMissing) where squeue is needed and absent.
SlurmState slurm_state(const std::string& folder);

/// Submits what is left of a plan as one array job (sbatch; its options can be set by SBATCH_... variables), takes
/// results into the store as they come, and returns how many stages ran once the job has left the queue. Where a job is
/// still at work it waits for that one instead of submitting another, so an interrupted call loses nothing. A task that
/// was lost leaves its cells waiting; its log is FOLDER/slurm/N.log. The folder must be one that the nodes see under
/// the same path. Throws Error: Cancelled, ToolMissing, and what `sweep` throws.
int run_on_slurm(const Plan& plan, Store& store, const SweepOptions& options, Progress& progress);

}  // namespace gsp
