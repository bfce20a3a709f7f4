#pragma once

#include "param/atlas/atlas.h"
#include "param/atlas/stretch.h"

namespace gsp {

/// Of a map's states after several rounds, keeps the one of least stretch.
class BestMap {
 public:
  void offer(const Atlas& atlas, int round) {
    const double stretch = l2_stretch(atlas);
    if (round_ >= 0 && stretch >= stretch_) return;
    atlas_ = atlas;
    stretch_ = stretch;
    round_ = round;
  }
  const Atlas& atlas() const { return atlas_; }
  int round() const { return round_; }

 private:
  Atlas atlas_;
  double stretch_ = 0.0;
  int round_ = -1;
};

}  // namespace gsp
