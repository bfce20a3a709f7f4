#pragma once

#include <functional>

#include "param/corners/corner_move.h"

namespace gsp {

/// Of the regions around corners, in units of a base edge: below 1/2, so that no two meet.
inline constexpr double kRelaxationRadius = 0.45;
enum class Folding { Allowed, Refused };

/// Lays out the region around each corner by `make`, which fills the move from the fresh disc or returns false; `make`
/// is called from several threads. A region that is refused, or would bring a fold where folds are, is tried smaller,
/// then left alone, and so are corners on feature curves. Returns how many were laid out.
using MakeCornerMove = std::function<bool(CornerDisc disc, CornerMove& move)>;
int move_corners(Atlas& atlas, double radius, Folding folding, const MakeCornerMove& make);

/// Corner relaxation (§3.2.2): around every interior patch corner the vertices within `radius` are mapped to a disc by
/// z^(6/k), the outermost are held, the inside is solved with the corner free, and the vertex nearest 0 becomes the
/// corner; positions, charts and transitions of the region follow from the disc. Around a boundary corner the same is
/// done in a half disc, and the corner stays. Regions are independent of each other and computed in parallel. Returns
/// how many were laid out; the global system has to be solved again.
int relax_corners(Atlas& atlas, const LinearWeights& weights, double radius, Folding folding);

}  // namespace gsp
