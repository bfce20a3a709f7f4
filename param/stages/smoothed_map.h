#pragma once

#include "param/atlas/atlas.h"

namespace gsp {

/// What the making of a smooth map has seen and kept.
struct SmoothingRecord {
  int rounds = 0;               ///< corner relaxations
  int edges_flipped = 0;        ///< of the base
  int flips_before_repair = 0;  ///< faces that the paper's linear solution folds; other maps never have any
  int held_vertices = 0;        ///< kept back from the smooth solution, which would be folded there
};

struct SmoothedMap {
  Atlas atlas;
  SmoothingRecord record;
};

}  // namespace gsp
