#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "param/overlay.h"

namespace gsp {

/// The complex of an overlay as a surface of its own, each face with the area of the part of the surface in it. Its vertices are
/// those of the complex in their order, its faces the complex's triangles in theirs, corner by corner. O(V).
struct CoarseSurface {
  std::shared_ptr<const Surface> surface;
  std::vector<int> vertex;  ///< per vertex, its number in the finer surface
  std::vector<int> slot;    ///< per face, the complex's triangle
};
CoarseSurface coarse_surface(const OverlayMap& overlay);

/// An overlay's map followed by a map of its complex: see `OverlayMap::followed_by`, which is the way to use it.
class Composition {
 public:
  Composition(OverlayMap& overlay, const RefinedMap& map);

  /// Cuts the pieces of the overlay along the edges of the second map's surface. False where one would be too small.
  bool cut();
  RefinedMap finish();

 private:
  using Line = PlanarRegion::Line;
  using Weights = std::array<double, 3>;

  /// The second surface's vertices on one edge of the coarse surface: share of it in its direction, vertex.
  using EdgeVertices = std::vector<std::pair<double, int>>;

  int coarse_face(int h) const { return map_.refined.origin(map_.halfedge[h] / 3); }
  void space(int edge, EdgeVertices& vertices);
  void spread(int face, const std::vector<int>& inside);
  bool cut_edge(int edge, const EdgeVertices& vertices);
  bool slide(int v, double share, int a, int b);
  bool cut_face(int face, const std::vector<int>& inside);
  bool distribute(int face, const std::vector<Line>& lines);
  Weights place_weights(int v, int slot) const;
  Complex flat_in(int v, int slot) const;
  Transition across(int h) const;
  Transition to_boundary_chart(int h, int& chart) const;
  Transition to_home(int v, int face) const;

  OverlayMap& overlay_;
  RefinedSurface& refined_;
  const RefinedMap& map_;
  const Surface& second_;             ///< the second map's surface
  CoarseSurface coarse_;
  std::vector<std::vector<int>> faces_of_;  ///< per coarse face, the faces of `second_` in it
  std::vector<Weights> corner_;       ///< per half-edge of `second_`, where it starts in the coarse face
  std::vector<int> vertex_;           ///< per vertex of `second_`, the overlay's vertex there, -1 before it is made
  std::vector<int> second_vertex_;    ///< per vertex of the overlay, that of `second_` it is at, -1
  std::vector<int> face_of_piece_;    ///< per piece, the face of `second_` that holds it
  std::vector<int> slot_of_piece_;    ///< per piece, the complex's triangle that holds it
  std::vector<Atlas::FaceFrame> frames_;  ///< per face of `second_`
  std::vector<int> home_;             ///< per vertex of the overlay, a face of `second_` that holds it,
  std::vector<Transition> from_home_; ///< and from that face's frame to the vertex's chart
};

}  // namespace gsp
