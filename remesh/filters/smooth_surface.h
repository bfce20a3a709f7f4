#pragma once

#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// Loop's limit surface of a control mesh at the vertices of a level.
struct SmoothSurface {
  std::vector<Vec3> points;   ///< #V
  std::vector<Vec3> normals;  ///< #V, unit
  /// #V, unit vectors out of the surface at right angles to its boundary; zero inside.
  std::vector<Vec3> conormals;
};

/// `levels`: from the base on; the surface is taken at the vertices of the last. `control`: the base's vertices. The
/// same bits on every machine, one thread. O(V).
SmoothSurface smooth_surface(const std::vector<SubdivisionLevel>& levels, std::vector<Vec3> control);

}  // namespace gsp
