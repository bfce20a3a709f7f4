#pragma once

#include <array>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// The surface over the domain, integrated against the hat functions of one level, and the vertex positions that are
/// nearest to it in the mean square: the L2 projection of the map's inverse onto the remesh's piecewise linear
/// functions. A surface that bends alike in all directions comes out four times nearer than where its points are taken
/// as vertices, a saddle no nearer.
///
/// Positions minimise, over the vertices of boundaries and creases, the integral along these curves; then, over all
/// others, that over the faces with the curves held. So curves are those of their own points alone, and shared by
/// whatever lies beside them. Corners and ends of creases stay samples. Integrals are over the domain: each face of the
/// level counts the same.
///
/// Where the surface turns within a face or two the nearest faces may fold. Of faces that so would turn or fold, and do
/// not with their samples (fold_guard.h), the corners stay samples, and the others are fitted to that.
class PositionFit {
 public:
  /// `steps` >= 1: points of the quadrature along each side of a face, less one. `finest` is kept by reference.
  PositionFit(const SubdivisionLevel& finest, int steps);

  /// The surface over face `face`: its points at the weights (steps - s - t, s, t) / steps of the corners, at
  /// `lattice_index(steps, s, t)`. Faces may be added from several threads at once.
  void add_face(int face, const std::vector<Vec3>& points);

  /// #V. Starts from `sampled`, #V: the surface over the vertices. A rigid motion of all points moves the result, up to
  /// rounding. Every face must have been added. O(V) for a given precision and each round of turned faces, one thread.
  std::vector<Vec3> fit(const std::vector<Vec3>& sampled) const;

  /// #F, twice the vector area of the surface over each face.
  const std::vector<Vec3>& surface_areas() const { return doubled_areas_; }

 private:
  const SubdivisionLevel& finest_;
  int steps_;
  std::vector<Vec3> doubled_areas_;
  std::vector<std::array<Vec3, 3>> face_moments_;  ///< #F, by corner
  std::vector<int> sharp_edges_;
  std::vector<int> place_;                         ///< #E, of an edge among the sharp ones, -1 for others
  std::vector<std::array<Vec3, 2>> edge_moments_;  ///< of sharp edges, by end in the direction of their face
};

}  // namespace gsp
