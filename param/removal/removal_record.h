#pragma once

#include <memory>
#include <vector>

#include "param/removal/vertex_map.h"

namespace gsp {

/// A complex as a surface of its own, each face with the area of the part of the finer surface in it. Its vertices are
/// those of the complex in their order, its faces the complex's triangles in theirs, corner by corner.
struct CoarseSurface {
  std::shared_ptr<const Surface> surface;
  std::vector<int> vertex;  ///< per vertex, its number in the finer surface
  std::vector<int> slot;    ///< per face, the complex's triangle
};

/// O(V).
CoarseSurface coarse_surface(const VertexMap& map);

/// Vertices that were taken out of a surface one after the other, with all that is needed to put them back.
class RemovalRecord {
 public:
  std::shared_ptr<const Surface> surface;
  CoarseSurface coarse;  ///< what remains

  int size() const { return static_cast<int>(centers_.size()); }
  /// The star of the removed vertex as it was, and the triangles that took its place, in the star's first slots.
  void add(const Star& star, const std::vector<RingTriangle>& triangles);
  void get(int removal, Star& star, std::vector<RingTriangle>& triangles) const;

 private:
  std::vector<int> centers_;
  std::vector<std::size_t> first_{
      0};                          ///< where a removal's ring starts in `ring_`, its triangles 2 per removal before it
  std::vector<int> ring_, slots_;  ///< slots: -1 after the last triangle of a star on a boundary
  std::vector<RingTriangle> triangles_;  ///< n - 2 of each
};

}  // namespace gsp
