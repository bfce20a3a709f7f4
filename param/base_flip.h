#pragma once

#include <array>
#include <optional>
#include <vector>

#include "param/atlas.h"

namespace gsp {

/// A base edge a-b with its two patches (a, b, c) and (b, a, d), which the edge c-d can replace.
struct FlipSite {
  int diagonal;                ///< the half-edge from a to b
  std::array<int, 4> corners;  ///< base vertices a, b, c, d
  std::array<int, 2> faces;    ///< of (a, b, c) and of (b, a, d); later of (c, a, d) and of (d, b, c)
};

/// Nothing where the base would not stay a simplicial complex, an interior base vertex would have fewer than three patches,
/// or the new edge would join two boundary vertices.
std::optional<FlipSite> flip_site(const Atlas& atlas, int diagonal);

/// The base faces at a site's corners, ascending.
std::vector<int> faces_around(const Atlas& atlas, const FlipSite& site);

/// Flips the edge. The two patches are mapped onto their successors by the affine map of the rhombus that they form, which is
/// continuous to the patches beside them; faces of the surface that cross the rhombus's sides may fold. `edges`: all edges of
/// the surface that may touch the two patches, or end at the site's corners. `vertices`: those in the two patches that are
/// no corners. False where the atlas could not be changed, and is not fit for use: some edge's way is not known, or joins two
/// patch corners.
bool flip(Atlas& atlas, const FlipSite& site, const std::vector<int>& vertices, const std::vector<int>& edges);

}  // namespace gsp
