#pragma once

#include "mesh/progress.h"
#include "remesh/remesh_options.h"
#include "remesh/semiregular.h"

namespace gsp {

struct DisplacedOptions {
  /// Sampled: displacements end on the surface. Fitted, Closest: the displaced surface is nearest to it in least
  /// squares, the latter with a tenth of the stiffness.
  Positions positions = Positions::Fitted;
  /// Control points lie on a grid of at most the diagonal over 2^control_bits, 4..24, so that a code of them is exact
  /// and its decoder has the same normals. Finer ones cost 3 bits a control point for each bit; coarser ones leave more
  /// to the displacements (bench/README.md, Displaced meshes).
  int control_bits = 7;
};

/// A remesh as a smooth surface and one number a vertex (Lee, Moreton, Hoppe 2000): control points, one for each base
/// vertex, whose Loop surface is near `surface`, and displacements along its normals at the vertices of `level` that
/// lead back to it; on boundaries a second one along the conormal. Where a base face stays far away, edges count too
/// and its control points are held closer to the map's places (PatchCare), and all is fitted again, six times at most.
///
/// `surface`: sampled, of `level` or finer; at least one level more gives the fit points to go by. `progress` notes how
/// many normals of a sampled remesh meet no surface. The same bits for any number of threads. O(V log V). Throws Error:
/// BadOption, NoArea where all vertices lie at one place, SolverFailed.
SemiregularMesh displaced_remesh(const SemiregularMesh& surface, int level, const DisplacedOptions& options,
                                 Progress& progress);

/// The largest grid of control points that is at most `step` > 0 (is_control_grid).
double control_grid_below(double step);

}  // namespace gsp
