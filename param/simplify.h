#pragma once

#include <memory>
#include <vector>

#include "mesh/progress.h"
#include "param/composition.h"
#include "param/overlay.h"
#include "param/parameterize.h"

namespace gsp {

/// The removals that made a complex, by vertices of the surface.
class RemovalScript {
 public:
  int size() const { return static_cast<int>(vertices_.size()); }
  void add(int vertex, const std::vector<Triangle>& triangles);
  int vertex(int removal) const { return vertices_[removal]; }
  /// Sets the removal's triangles for a star as the complex gathers it.
  void place(int removal, const Star& star, Removal& made) const;

 private:
  std::vector<int> vertices_, first_{0};
  std::vector<Triangle> triangles_;
};

/// The simplification is made in levels: the complex of one, with about an eighth of its vertices left, is the surface of the
/// next. So a removal has few pieces to lay out however large the surface is, and the map can be smoothed from coarse to fine.
struct SimplifyResult {
  std::vector<OverlayMap> levels;  ///< finest first; the last one's complex is the base
  RemovalScript removals;          ///< by vertices of the finest surface
  std::vector<OmegaRecord> omega;  ///< one record per removal, in order; then of that at which the automatic stop was
};

/// Builds the base complex by greedy vertex removal (§3.1), carrying the map. Stops at options.base_vertices, or where no
/// vertex can be removed: the star would not stay a disc, the complex not an embedded one, or a piece of the overlay would be
/// too small for rounding. `most_levels`: at least 1. Deterministic.
SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, int most_levels,
                        Progress& progress);

/// The vertices of the surface that the removals leave, in order.
std::vector<int> remaining_vertices(const Surface& surface, const RemovalScript& removals);

/// The same removals with the map of the vertices alone, as MAPS carries it.
Atlas maps_of(const SimplifyResult& simplified);

}  // namespace gsp
