#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"

namespace gsp {

/// Moves the vertices on feature curves, along which the surface of a map without folds was cut, to their places by arc
/// length between the two corners of their base edge, so that both copies of one lie at the same; what is around them
/// gives way, without folds. False, and the map unchanged, where they could not get there. Nothing where the surface
/// was not cut. Throws Error(Cancelled).
bool settle_creases(Atlas& atlas, Progress& progress);

}  // namespace gsp
