#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"

namespace gsp {

/// The historical MAPS baseline (the paper's figure 1a): the initial map followed by the inverse of Loop subdivision on
/// the parameters. The base domain is quadrisected; the location of every dyadic point in the domain is smoothed by the
/// Loop masks (`SmoothedDomain`). A vertex whose initial location is L(t) gets the location t. The number of levels
/// gives several dyadic triangles per face of the surface. MAPS evaluated its own map at every dyadic point, where
/// nothing folds; a face of the surface, drawn straight, may be too coarse for the bend and fold. Such folds are
/// untangled in the discs around them (`repair_folds`). Returns how many faces there were; `check_map` counts what is
/// left.
int smooth_by_loop(Atlas& atlas, Progress& progress);

}  // namespace gsp
