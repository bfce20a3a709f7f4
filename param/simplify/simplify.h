#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesh/progress.h"
#include "param/options.h"
#include "param/removal/removal_record.h"
#include "param/simplify/overlay.h"
#include "param/simplify/removal_script.h"

namespace gsp {

/// The simplification is made in levels: the complex of one is the surface of the next. Only the last, small one
/// carries the map as a homeomorphism, down to the base; the vertices that those before it took out are put back into
/// its map once it is smooth.
struct SimplifyResult {
  std::vector<RemovalRecord> finer;  ///< finest first
  std::optional<OverlayMap> map;     ///< of what they left onto the base
  RemovalScript removals;            ///< by vertices of the finest surface
  /// The finest one, which was simplified.
  const std::shared_ptr<const Surface>& surface() const {
    return finer.empty() ? map->surface() : finer.front().surface;
  }
  std::vector<OmegaRecord> omega;  ///< one record per removal, in order; then of that at which the automatic stop was
};

/// Builds the base complex by greedy vertex removal (§3.1), carrying the map. Stops at options.base_vertices, or where
/// no vertex can be removed: the star would not stay a disc, the complex not an embedded one, or a piece of the overlay
/// would be too small for rounding. On a surface that was cut open along feature curves both copies of a vertex inside
/// one are removed at once, and the corners of curves stay; what is counted are vertices of the whole surface, and the
/// complex glued together stays an embedded one. `coarsest`: vertices with which the last level starts at the latest,
/// such as `coarsest_level` has it; no less than the surface's for a single level. Deterministic.
SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, int coarsest,
                        Progress& progress);

/// Few enough vertices that the last level is cheap, many enough that its patch corners do not stand in each other's
/// way.
int coarsest_level(const Surface& surface, const ParameterizeOptions& options);

/// The vertices of the surface that the removals leave, in order.
std::vector<int> remaining_vertices(const Surface& surface, const RemovalScript& removals);

}  // namespace gsp
