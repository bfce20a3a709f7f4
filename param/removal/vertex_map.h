#pragma once

#include <memory>
#include <vector>

#include "param/atlas/atlas.h"
#include "param/removal/removal_cost.h"
#include "param/removal/triangle_complex.h"

namespace gsp {

/// Where the surface's vertices lie on the shrinking complex T^i of §3.1, as MAPS carries them.
class VertexMap {
 public:
  explicit VertexMap(std::shared_ptr<const Surface> surface);

  const Surface& surface() const { return *surface_; }
  const TriangleComplex& complex() const { return complex_; }
  const std::vector<Location>& locations() const { return locations_; }
  /// Per triangle of the complex, the surface's vertices inside it.
  const std::vector<std::vector<int>>& points() const { return points_; }

  /// Fills the hole of the removed vertex; the points of its star move to where `flatten_star` puts them.
  void remove(const Removal& removal);

 private:
  std::shared_ptr<const Surface> surface_;
  TriangleComplex complex_;
  std::vector<Location> locations_;
  std::vector<std::vector<int>> points_;

  Star star_;  // of the removal in hand
  std::vector<Complex> ring_;
  std::vector<int> slots_, moving_;
  std::vector<Complex> moving_flat_;
};

}  // namespace gsp
