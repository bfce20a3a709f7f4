#pragma once

#include <vector>

#include "remesh/displaced/control_system.h"
#include "remesh/displaced/fit_target.h"

namespace gsp {

/// How the control points are found.
struct ControlFitOptions {
  /// Rounds of Gauss-Newton steps, 0..100, after the points by the map. More than 3 change little.
  int rounds = 3;
  /// #F of the base: weight of the distance to the map's own places beside that to the nearest ones, > 0. More keeps
  /// the limit surface beside the surface where it would slip to another sheet.
  std::vector<double> stiffness;
};

/// Control points whose limit surface is near the surface: first by least squares to the points that the map puts at
/// the same places of the domain, then to the nearest points, both from the surface and to it, with
/// boundaries by themselves. `samples` are those of
/// the target and leave as nearest places on the limit surface. The same bits for any number of threads.
/// Throws Error(SolverFailed).
std::vector<Vec3> fit_control(const ControlMap& map, const std::vector<SubdivisionLevel>& levels,
                              const FitTarget& target, const ControlFitOptions& options,
                              std::vector<SurfaceSample>& samples);

}  // namespace gsp
