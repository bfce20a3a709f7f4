#pragma once

#include <vector>

#include "param/map/development.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A vertex of a remesh, above its base, in the domain.
struct DomainVertex {
  int home = 0;   ///< base face in whose chart, continued over the plane, it is given
  int side = -1;  ///< the base half-edge of `home` that the vertex was inserted on; -1: inside
  Complex z;
  int chart = 0;    ///< the base face whose triangle holds it
  Transition into;  ///< from `home`'s chart into `chart`'s

  Complex in_chart() const { return into.apply(z); }
};

/// The faces of a remesh as triangles of the domain, level by level, wherever its vertices lie there. Base vertices
/// stay at their corners. Faces that come from one base face are given in its chart, continued over the plane; over
/// edges that come from a base edge that chart changes exactly. No corner lies inside an upright face, so that the
/// continuation has one meaning for each.
class RemeshDomain {
 public:
  /// At the base level. Both are kept by reference.
  RemeshDomain(const BaseComplex& base, const std::vector<SubdivisionLevel>& levels);

  int level() const { return level_; }
  const SubdivisionLevel& connectivity() const { return levels_[level_]; }
  const std::vector<DomainVertex>& vertices() const { return vertices_; }  ///< those above the base

  /// In the chart of the face's base face.
  Complex corner(int face, int k) const;
  std::array<Complex, 3> corners(int face) const { return {corner(face, 0), corner(face, 1), corner(face, 2)}; }

  /// The base half-edge, of the base face of its first face, that an edge comes from; -1 for edges inside base faces.
  int side(int edge) const { return sides_[edge]; }
  /// The base face of an edge's first face.
  int home(int edge) const { return base_face(connectivity().edge_faces[edge][0]); }
  /// From the chart of the edge's first face into that of `face`, one of its faces.
  Transition across(int edge, int face) const;

  /// The base faces that a face reaches; `motion` is from the chart of its own base face.
  std::vector<FacePiece> reach(int face) const;

  /// Goes to the next level, whose new vertices, #E, are given in the chart of their edge's first face.
  void refine(std::vector<DomainVertex> inserted);

 private:
  int base_face(int face) const { return face >> (2 * level_); }

  const BaseComplex& base_;
  const std::vector<SubdivisionLevel>& levels_;
  int level_ = 0;
  std::vector<DomainVertex> vertices_;
  std::vector<int> sides_;  ///< #E of the level
};

}  // namespace gsp
