#pragma once

#include "param/creases/cut_surface.h"
#include "param/map/parameterization.h"

namespace gsp {

/// The map of a cut surface as one of the whole: the copies of a vertex become one again, base vertices too, and the
/// base edges along the cuts its creases. Vertices inside a curve must lie at the same place of their base edge on both
/// sides (`settle_creases`). O(V + F).
Parameterization glue_map(Parameterization map, const CutSurface& cut);

}  // namespace gsp
