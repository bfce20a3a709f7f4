#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "param/map/base_complex.h"
#include "param/map/lattice.h"

namespace GSP_PUBLIC gsp {

/// A map of a surface onto its base complex, piecewise linear over the surface's faces.
struct Parameterization {
  /// The input surface in the input's vertex order; vertices that local refinement added come last. Faces that
  /// refinement split are replaced in place, the further pieces come last.
  Mesh surface;
  BaseComplex base;
  /// #V base face that holds the vertex (for a base vertex: one of those around it); -1 for isolated vertices.
  std::vector<int> patch;
  /// #V position in the chart of `patch`; its barycentric coordinates are non-negative up to rounding.
  std::vector<Complex> position;
  /// #F base face in whose chart the face's three corners are given.
  std::vector<int> face_chart;
  /// #F chart positions of the three corners. They may lie outside the chart's triangle and are consistent in the face.
  std::vector<std::array<Complex, 3>> face_corners;
  /// What made it: the method and every option, one "key value" a line. Written to the file's comments.
  std::vector<std::string> provenance;
};

/// Vertices and faces of the input, before further ones were added where the map needs them: of the provenance
/// ("input_vertices N", "input_faces N"), or those of the surface where it does not say.
int input_vertex_count(const Parameterization& map);
int input_face_count(const Parameterization& map);

/// What `check_map` found. A map is valid where all of these hold.
struct MapCheck {
  int flipped_faces = 0;  ///< faces with no positive area in their chart
  int first_flipped = -1;
  double area_error = 0.0;  ///< |sum of face areas - #P·√3/4| / (#P·√3/4)
  /// Vertices whose chart angles do not sum to 2π (base vertex of valence k: kπ/3; boundary: π, or kπ/3 at a corner):
  /// folds that positive areas alone cannot see.
  int wrong_angle_vertices = 0;
  int first_wrong_angle = -1;
  /// Vertices whose `position` lies outside the triangle of their `patch`, base vertices that are not at their corner,
  /// and vertices whose `position` no lattice motion takes to a corner of a face around them (all to 1e-9).
  int misplaced_vertices = 0;
  int first_misplaced = -1;
  /// Edges on which the charts of the two faces do not differ by an exact lattice motion (to 1e-9).
  int mismatched_edges = 0;
  /// Edges whose middle lies at another place of the base by one of their two faces than by the other: a vertex has the
  /// chart of another sector about a corner, or of the other side of a handle.
  int torn_edges = 0;
  int first_torn = -1;  ///< a face at one

  bool valid() const {
    return flipped_faces == 0 && wrong_angle_vertices == 0 && misplaced_vertices == 0 && mismatched_edges == 0 &&
           torn_edges == 0 && area_error < 1e-9;
  }
};

/// Throws where the arrays do not fit together: sizes, indices out of range, values that are not finite, a vertex of a
/// face without a patch, a base face that names a vertex twice, twins that are not those of the base faces.
/// Says nothing about the map itself. Throws Error: Malformed, IndexOutOfRange, NonFinite. O(V + F).
void require_well_formed(const Parameterization& map);

/// Checks a map without trusting how it was made: from positions and face corners alone. Positive areas, angle sums and
/// exact transitions make it a covering of the base, and the area sum makes it cover once. O(V + F).
/// Throws the errors of `require_well_formed`.
MapCheck check_map(const Parameterization& map);

}  // namespace gsp
