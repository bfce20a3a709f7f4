#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"
#include "param/atlas/folds.h"
#include "param/energy/distortion_energy.h"

namespace gsp {

/// Minimises the energy while ε is driven to zero, with so many steps of L-BFGS for each, until every face is upright.
/// False where some are not in the end.
bool drive_apart(const DistortionEnergy& energy, std::vector<double>& x, int inner_steps);

/// What faces are drawn to while they are untangled.
enum class UntangleToward {
  Surface,     ///< their own shapes on the surface
  Equilateral  ///< one and the same shape: thin faces, whose own shapes hold each other fast, come free
};

/// Untangles folded faces: in the discs around them, with their rims, the boundary and all corners held, minimises
/// `DistortionEnergy` while ε is driven to zero (Garanzha et al. 2021). The rest of the map stays bit for bit. A disc
/// that does not come free, or comes free wrongly wound, is left as it was, grown to at most so many rings of vertices
/// around the folds (and a number of vertices that bounds the time), and tried again; so folds may remain, which are
/// returned. Vertices keep their charts, which they may leave.
Folds repair_folds(Atlas& atlas, int most_rings, Progress& progress, UntangleToward toward = UntangleToward::Surface);

}  // namespace gsp
