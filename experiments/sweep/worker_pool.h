#pragma once

#include "experiments/sweep/sweep.h"

namespace gsp {

/// Runs what is left of a plan in worker processes of this machine and takes their results into the store; returns how
/// many stages ran. As many workers at a time as `options.jobs` and the memory at hand allow. Throws what `sweep`
/// throws.
int run_in_workers(const Plan& plan, Store& store, const SweepOptions& options, Progress& progress);

}  // namespace gsp
