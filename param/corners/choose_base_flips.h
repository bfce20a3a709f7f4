#pragma once

#include "mesh/progress.h"
#include "param/atlas/atlas.h"

namespace gsp {

/// Flips base edges where that lowers the distortion, the map around each smoothed before it is judged. The map is free
/// of folds before and after. Returns how many edges were flipped. Cost: a Newton descent over the patches at the
/// corners of each edge that the mean metric of its two patches speaks for, so meant for a coarse level.
int flip_base_edges(Atlas& atlas, Progress& progress);

}  // namespace gsp
