#pragma once

#include <memory>
#include <vector>

#include "mesh/progress.h"
#include "param/atlas.h"
#include "param/parameterize.h"
#include "param/shrinking_map.h"

namespace gsp {

struct SimplifyResult {
  Atlas atlas;                      ///< with the initial map, every edge classified
  std::vector<Removal> removals;    ///< in order: they make the base complex again
  std::vector<OmegaRecord> omega;   ///< one record per removal, in order
};

/// Builds the base complex by greedy vertex removal (§3.1), carrying the initial map and the edge classification.
/// Stops at options.base_vertices, or where no vertex can be removed. Deterministic.
SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options,
                        Progress& progress);

}  // namespace gsp
