#pragma once

#include <string>
#include <vector>

#include "experiments/cells/recipe.h"
#include "experiments/curve/summary.h"
#include "experiments/store/store.h"
#include "mesh/progress.h"

namespace gsp {

struct SweepOptions {
  /// Worker processes at most; 0: as many as there are threads (mesh/parallel.h). Fewer run where memory would not hold
  /// their surfaces.
  int jobs = 0;
  bool fail_fast = false;     ///< stop at the first cell that fails
  bool retry_failed = false;  ///< forget failures; those from a crash or lack of memory are always forgotten
  bool slurm = false;         ///< as a Slurm job array instead of processes here (slurm.h)
  std::string program;        ///< the gsp program, which workers run
};

struct SweepResult {
  std::vector<StoredCell> cells;  ///< of the recipe, as they are now
  int stages_run = 0;             ///< in this call; the rest was there
  bool failed() const;            ///< a cell failed
};

/// Runs all cells of a recipe that have not run, in worker processes, and writes FOLDER/curve.csv. Whatever ends it,
/// the next call goes on: at most the stages in flight are lost, and the store ends up the same but for times. A cell
/// that fails, even by crashing its worker, is a result with its cause, and the others go on. Throws Error: Cancelled;
/// CannotWrite, also where another sweep or its Slurm job is at work on the folder; ToolMissing.
SweepResult sweep(const Recipe& recipe, const std::string& folder, const SweepOptions& options, Progress& progress);

/// The recipe's cells as they stand in the folder (which need not exist), without changing anything.
std::vector<StoredCell> planned_cells(const Recipe& recipe, const std::string& folder);

/// True while a sweep is at work on the folder.
bool sweep_at_work(const std::string& folder);

/// Summaries of the models, one curve a cell; a model's failures are those of its first failed cell.
std::vector<CurveSummary> summaries_of(const std::vector<StoredCell>& cells);

/// All rows of the cells, in their order.
std::vector<CurvePoint> points_of(const std::vector<StoredCell>& cells);

}  // namespace gsp
