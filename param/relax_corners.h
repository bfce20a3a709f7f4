#pragma once

#include "param/atlas.h"
#include "param/weights.h"

namespace gsp {

/// Corner relaxation (§3.2.2): around every interior patch corner the vertices within `radius` (below 1/2, so that no two
/// regions meet; in units of a base edge) are mapped to a disc by z^(6/k), the outermost are held, the inside is solved
/// with the corner free, and the vertex nearest 0 becomes the corner; positions, charts and transitions of the region
/// follow from the disc. Around a boundary corner the same is done in a half disc, and the corner stays. A region that is no
/// disc, or would bring a fold where folds are refused, is tried smaller, then left alone. Regions are independent of each
/// other and computed in parallel. Returns how many were laid out; the global system has to be solved again.
inline constexpr double kRelaxationRadius = 0.45;
enum class Folding { Allowed, Refused };
int relax_corners(Atlas& atlas, const LinearWeights& weights, double radius, Folding folding);

}  // namespace gsp
