#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"

namespace gsp {

/// The historical MAPS baseline (the paper's figure 1a): the initial map followed by the inverse of Loop subdivision on
/// the parameters. The base domain is quadrisected; the location of every dyadic point in the domain is smoothed by the
/// Loop masks, averaged in the plane of its base triangle or, across a base edge, in the two triangles unfolded about
/// it with their true shapes; base vertices stay. A vertex whose initial location is L(t) gets the location t. The
/// number of levels gives several dyadic triangles per face of the surface. May leave folded faces, as the published
/// baseline does.
void smooth_by_loop(Atlas& atlas, Progress& progress);

}  // namespace gsp
