#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/sweep/task.h"

namespace gsp {

/// What is left to do of a plan, by tasks: cells on one map and its baselines together, each anchor alone; the dearest
/// first. `done` are the results at hand; cells whose fate they settle are left out.
std::vector<Task> outstanding_tasks(const Plan& plan, const std::map<std::string, StageResult>& done);

/// True where nothing is left to do for the cell: measured, or a stage failed.
bool settled(const PlannedCell& cell, const std::map<std::string, StageResult>& done);

/// Memory that a worker will need at most. Measured: 160 MB for 97,000 faces; a remesh may have four times as many.
double task_memory_bytes(const Plan& plan, const Task& task);

/// How much work is left in a task, in arbitrary units, for the remaining time.
double task_weight(const Plan& plan, const Task& task);

}  // namespace gsp
