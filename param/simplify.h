#pragma once

#include <memory>
#include <vector>

#include "mesh/progress.h"
#include "param/atlas.h"
#include "param/overlay.h"
#include "param/parameterize.h"

namespace gsp {

struct SimplifyResult {
  Atlas atlas;                      ///< with the initial map of the vertices, every edge classified
  OverlayMap overlay;               ///< the same map as a homeomorphism
  std::vector<OmegaRecord> omega;   ///< one record per removal, in order; then of that at which the automatic stop was
};

/// Builds the base complex by greedy vertex removal (§3.1), carrying the initial map and the edge classification.
/// Stops at options.base_vertices, or where no vertex can be removed: the star would not stay a disc, the complex not an
/// embedded one, or a piece of the overlay would be too small for rounding. Deterministic.
SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options,
                        Progress& progress);

}  // namespace gsp
