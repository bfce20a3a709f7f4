#pragma once

#include <memory>
#include <vector>

#include "param/atlas/atlas.h"
#include "param/removal/edge_paths.h"
#include "param/removal/removal_cost.h"
#include "param/removal/triangle_complex.h"

namespace gsp {

/// The surface's map onto the shrinking complex T^i of §3.1: a homeomorphism up to the straightening of edges.
class VertexMap {
 public:
  /// `classify`: whether to follow the edges too, which `atlas` needs.
  VertexMap(std::shared_ptr<const Surface> surface, bool classify);

  const Surface& surface() const { return *surface_; }
  const TriangleComplex& complex() const { return complex_; }
  const std::vector<Location>& locations() const { return locations_; }
  /// Per triangle of the complex, the surface's vertices inside it.
  const std::vector<std::vector<int>>& points() const { return points_; }

  /// Fills the hole of the removed vertex; the points of its star move to where `flatten_star` puts them.
  void remove(const Removal& removal);

  /// The map onto the present complex with every edge classified. O(V).
  Atlas atlas() const;

 private:
  struct Numbering {
    std::vector<int> face_of;  ///< slot -> base face, -1
    std::vector<int> slot_of;  ///< base face -> slot
  };
  Numbering number_triangles() const;
  Transition edge_transition(const Atlas& atlas, const Numbering& numbering, int edge) const;

  std::shared_ptr<const Surface> surface_;
  bool classify_;
  TriangleComplex complex_;
  std::vector<Location> locations_;
  std::vector<std::vector<int>> points_;
  EdgePaths paths_;

  Star star_;  // of the removal in hand
  std::vector<Complex> ring_;
  std::vector<int> slots_, moving_;
  std::vector<Complex> moving_flat_;
};

}  // namespace gsp
