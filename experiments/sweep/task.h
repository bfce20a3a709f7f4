#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace gsp {

/// What one worker process does: cells on one surface that share as much as they can, such as all codings of one map.
/// It travels as a JSON file, and so do the results, so that a worker never opens the database: that is the sweep's
/// alone.
struct Task {
  std::string surface_key;
  std::string surface;  ///< PLY, relative to the store's folder
  std::vector<PlannedCell> cells;
  std::map<std::string, StageResult> done;  ///< stages of the cells that have run, failed ones included
};

/// Throw Error: CannotWrite; CannotOpen, Malformed.
void write_task(const std::string& path, const Task& task);
Task read_task(const std::string& path);
void write_result(const std::string& path, const StageResult& result);
StageResult read_result(const std::string& path);

/// Where workers of a store leave results for the sweep to take in.
std::string inbox_folder(const std::string& store);

}  // namespace gsp
