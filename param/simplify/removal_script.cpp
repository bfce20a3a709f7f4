#include "param/simplify/removal_script.h"

#include <algorithm>

namespace gsp {

RingTriangle in_ring(const Star& star, const Triangle& vertices) {
  RingTriangle t;
  for (int k = 0; k < 3; ++k)
    t[k] = static_cast<int>(std::find(star.ring.begin(), star.ring.end(), vertices[k]) - star.ring.begin());
  std::sort(t.begin(), t.end());
  return t;
}

void RemovalScript::add(int vertex, const std::vector<Triangle>& triangles) {
  vertices_.push_back(vertex);
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  first_.push_back(static_cast<int>(triangles_.size()));
}

void RemovalScript::place(int removal, const Star& star, Removal& made) const {
  made.vertex = vertices_[removal];
  made.triangles.clear();
  for (int i = first_[removal]; i < first_[removal + 1]; ++i) made.triangles.push_back(in_ring(star, triangles_[i]));
}

}  // namespace gsp
