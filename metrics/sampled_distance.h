#pragma once

#include <string>

#include "mesh/nearest/triangle_tree.h"
#include "metrics/surface_distance.h"

namespace gsp {

/// One direction of `surface_distance`. `diagonal`: of the reference, below whose rounding there is no distance to
/// resolve.
OneWayDistance sampled_distance(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to,
                                double diagonal, const DistanceOptions& options, const std::string& stage,
                                Progress& progress);

}  // namespace gsp
