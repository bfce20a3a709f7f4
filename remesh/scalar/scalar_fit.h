#pragma once

#include <vector>

#include "remesh/closest_energy.h"
#include "remesh/closest_fit.h"
#include "remesh/semiregular.h"

namespace gsp {

struct ScalarFit {
  std::vector<Vec3> positions;  ///< #V, of a mesh that one number a vertex gives, but for exceptions (ScalarForm)
  double rms = 0.0;             ///< of the samples' distances
};

/// The mesh of base positions and one number a vertex that is nearest to a surface: Gauss-Newton steps through the
/// synthesis (scalar_synthesis.h) down the squared distances of `samples`, from the form nearest to `start`, #V. So
/// every detail has the direction of its frame's normal, and the surface they make fits in least squares, in place of
/// vertices that lie on it (after Friedel, Schröder, Khodakovsky 2004, who perturb the map). Vertices on the boundary
/// are held to `start`, and springs hold moves together as in `fit_closest`. A step is taken only where it lowers the
/// energy and turns no face.
///
/// `levels`: from the base to the finest. `exceptional`: #V - #B, the vertices that keep three numbers. `lifted`:
/// details of lifted Butterfly, else of Butterfly. `effort` without rounds leaves the form nearest to `start`. The same
/// bits on any number of threads. O(V + samples).
ScalarFit fit_scalars(const std::vector<SubdivisionLevel>& levels, const std::vector<char>& exceptional, bool lifted,
                      std::vector<SurfaceSample> samples, const FitEffort& effort, const std::vector<Vec3>& start);

}  // namespace gsp
