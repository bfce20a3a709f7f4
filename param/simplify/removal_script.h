#pragma once

#include <vector>

#include "param/removal/triangle_complex.h"

namespace gsp {

/// A triangle of ring vertices as indices into the star's ring, increasing.
RingTriangle in_ring(const Star& star, const Triangle& vertices);

/// The removals that made a complex, by vertices of the surface.
class RemovalScript {
 public:
  int size() const { return static_cast<int>(vertices_.size()); }
  void add(int vertex, const std::vector<Triangle>& triangles);
  int vertex(int removal) const { return vertices_[removal]; }
  /// Sets the removal's triangles for a star as the complex gathers it.
  void place(int removal, const Star& star, Removal& made) const;

 private:
  std::vector<int> vertices_, first_{0};
  std::vector<Triangle> triangles_;
};

}  // namespace gsp
