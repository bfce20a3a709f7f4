#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Bits of EncodeOptions::precision_bits with which the whole stream's own error costs less than 0.1 dB beside the
/// distance between a smooth surface and its remesh, whose vertices are `positions`. That surface is not at hand, so
/// its curvature is read off the heights of the finest vertices over their parent edges. `coarse`: the last level but
/// one, whose edges the finest vertices lie on; `diagonal`: of the bounding box. At least 16 and at most 24, which
/// flat meshes have. O(N).
int sufficient_precision(const SubdivisionLevel& coarse, const std::vector<Vec3>& positions, double diagonal);

}  // namespace gsp
