#pragma once

#include <memory>
#include <vector>

#include "remesh/filters/filter.h"
#include "remesh/semiregular.h"

namespace gsp {

/// From the vertices of a level to the points of Loop's limit surface over them (Loop 1987; on boundaries the cubic
/// spline's, and where another number than two boundary edges meet the vertex itself: the rules of `loop_low_pass`).
std::unique_ptr<Filter> loop_limit_points(const SubdivisionLevel& level);

/// #V unit normals of the limit surface over the vertices of a level, by the tangent masks of Hoppe et al. 1994. Where
/// tangents are parallel or vanish: the mean normal of the faces around, or the z axis. By operations that IEEE 754
/// fixes and in a fixed order: the same bits on every machine. O(V).
std::vector<Vec3> loop_limit_normals(const SubdivisionLevel& level, const std::vector<Vec3>& positions);

/// #V unit vectors that lie in the limit surface and leave it at right angles to its boundary curve; zero for vertices
/// that do not have two boundary edges and where the curve stands still. `normals`: those of the limit surface. O(V),
/// by the same operations.
std::vector<Vec3> loop_limit_conormals(const SubdivisionLevel& level, const std::vector<Vec3>& positions,
                                       const std::vector<Vec3>& normals);

}  // namespace gsp
