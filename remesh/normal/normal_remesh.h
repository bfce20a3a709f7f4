#pragma once

#include <cstdint>
#include <vector>

#include "mesh/progress.h"
#include "param/map/development.h"
#include "remesh/normal/remesh_domain.h"
#include "remesh/semiregular.h"

namespace gsp {

/// How a vertex above the base is given.
enum class VertexForm : std::uint8_t {
  Normal,      ///< on the normal through its prediction
  Parametric,  ///< where the map has it: an exception, with three components
  Boundary,    ///< the same, on a boundary or crease, whose curves have no normals of their own
};

struct NormalOptions {
  /// Farthest place from the middle of an edge, in edges of the domain, 0..1; a tenth of it in base edges. Wider ones
  /// leave fewer exceptions, but spread the vertices less evenly than the map does (bench/README.md, Normal remeshes).
  double aperture = 0.1;
  /// Where the normal offers nothing, its point nearest to the surface's point over the middle is taken if it is not
  /// farther away than this, in the surface's units, >= 0: no exception, but off the surface.
  double tolerance = 0.0;
  /// Vertices are predicted by Loop's rules for new ones, in place of Butterfly's.
  bool loop = false;
};

struct NormalRemesh {
  std::vector<Vec3> positions;    ///< #V of the finest level, on the surface, up to the tolerance
  RemeshDomain domain;            ///< at the finest level
  std::vector<VertexForm> forms;  ///< of the vertices above the base
};

/// Inserts level by level each vertex where the normal through its prediction leaves the surface (Guskov, Vidimče,
/// Sweldens, Schröder 2000): predicted by Butterfly, or Loop, from the level's positions, along the normal of the
/// edge's frame (local_frames.h), so that in a decoder's frame of that level its detail has no tangential part, up to
/// rounding. Of several points the one counts whose place in the domain is nearest to the middle of the edge. It is
/// taken within the aperture and where the triangles of the domain stay upright; so they cover the domain once, and the
/// remesh is a homeomorphic image of it. Where there is none the surface's point over the middle is taken.
///
/// `levels`: of the base of `map`, from 0 to the finest; kept by reference. `pieces`: the map's faces by chart. The
/// same bits on any number of threads. O(faces + vertices). Throws Error(InvalidMap) where a base face is not covered.
NormalRemesh normal_remesh(const Parameterization& map, const std::vector<std::vector<FacePiece>>& pieces,
                           const std::vector<SubdivisionLevel>& levels, const NormalOptions& options,
                           Progress& progress);

}  // namespace gsp
