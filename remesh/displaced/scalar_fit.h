#pragma once

#include <vector>

#include "remesh/closest_fit.h"
#include "remesh/filters/smooth_surface.h"

namespace gsp {

/// The surface as a mesh of its own, for the distance from the fit back to it.
struct SampledSurface {
  const SubdivisionLevel* level;
  const std::vector<Vec3>* positions;
  std::vector<LevelPlace> places;  ///< #V of the fit: nearest place so far
  double weight = 1.0;
};

struct ScalarFitOptions {
  double stiffness = 5e-3;
  double enough = 0.03;
  int most_rounds = 10;
  double damping = 0.02;
  double reach = 0.25;
  double tangential = 0.5;  ///< weight of what goes along the surface
};

std::vector<Vec3> fit_displacements(const SubdivisionLevel& finest, const SmoothSurface& surface,
                                std::vector<SurfaceSample>& samples, const ScalarFitOptions& options,
                                const std::vector<Vec3>& start, SampledSurface& back);

std::vector<Vec3> displaced_points(const SmoothSurface& surface, const std::vector<double>& scalars);

}  // namespace gsp
