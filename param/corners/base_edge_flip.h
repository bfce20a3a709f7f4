#pragma once

#include <array>
#include <optional>
#include <vector>

#include "param/atlas/atlas.h"

namespace gsp {

/// A base edge a-b with its two patches (a, b, c) and (b, a, d), which the edge c-d can replace.
struct FlipSite {
  int diagonal;                ///< the half-edge from a to b
  std::array<int, 4> corners;  ///< base vertices a, b, c, d
  std::array<int, 2> faces;    ///< of (a, b, c) and of (b, a, d); later of (c, a, d) and of (d, b, c)

  bool operator==(const FlipSite&) const = default;
};

/// Nothing where the base would not stay a simplicial complex, an interior base vertex would have fewer than three
/// patches, or the new edge would join two boundary vertices.
std::optional<FlipSite> flip_site(const Atlas& atlas, int diagonal);

/// The base faces at a site's corners, ascending.
std::vector<int> faces_around(const Atlas& atlas, const FlipSite& site);

/// The base edges that an edge of the surface crosses.
struct Way {
  int edge;
  int start, end;          ///< its vertices; if the start is a patch corner both are, and it runs along a base edge
  bool forward;            ///< whether the edge's direction leaves the start
  std::vector<int> sides;  ///< half-edges of the base, each of the face that is left
};

/// The ways that a flip changes. `edges`: all edges of the surface that may touch the site's patches, or end at its
/// corners. Nothing where the edge cannot be flipped: some edge's way is not known, or joins two patch corners across a
/// patch.
std::optional<std::vector<Way>> changed_ways(const Atlas& atlas, const FlipSite& site, const std::vector<int>& edges);

/// Flips the edge. The two patches are mapped onto their successors by the affine map of the rhombus that they form,
/// which is continuous to the patches beside them; faces of the surface that cross the rhombus's sides may fold.
/// `ways`: those that the flip changes. `vertices`: those in the two patches that are no corners. False where a way
/// could not be followed through the new patches, such as one along the flipped edge; the atlas is then not fit for
/// use.
bool flip(Atlas& atlas, const FlipSite& site, const std::vector<int>& vertices, const std::vector<Way>& ways);

}  // namespace gsp
