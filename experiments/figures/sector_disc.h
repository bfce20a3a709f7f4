#pragma once

#include "param/map/parameterization.h"

namespace gsp {

// The paper's figure 9: what a map looks like around a patch corner of any valence.

/// The map of a flat disc of `sectors` >= 3 equilateral base triangles, quadrisected `level` >= 1 times, by the global
/// system with mean value weights (§3.2.1), the centre and the boundary held. Throws Error(SolverFailed).
Parameterization relaxed_sector_disc(int sectors, int level);

/// The same base triangles subdivided `level` >= 1 times by Loop, whose vertices stand where subdivision put them.
Parameterization loop_sector_disc(int sectors, int level);

}  // namespace gsp
