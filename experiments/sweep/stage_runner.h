#pragma once

#include <functional>
#include <string>

#include "experiments/sweep/task.h"
#include "mesh/progress.h"

namespace gsp {

/// Runs all stages of a task's cells that have not run yet, each once, in the store's folder. Whatever is finished
/// stands at once in the store's inbox as a JSON file; a stage that fails is a result with its cause, and the others go
/// on. `begin` is called with the key of each stage before it runs. Throws Error: Cancelled, CannotWrite.
void run_task(const std::string& store, const Task& task, const std::function<void(const std::string& key)>& begin,
              Progress& progress);

}  // namespace gsp
