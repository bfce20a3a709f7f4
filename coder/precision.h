#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Precision with which the whole stream's own error costs about 0.04 dB, and less than 0.1 dB, beside the distance
/// between a scanned surface and its remesh, whose vertices are `positions`: passes of the bit-plane coder,
/// kPassesPerPlane to each of EncodeOptions::precision_bits. That surface is not at hand, so its curvature is read off
/// the heights of the finest vertices over their parent edges. (A sphere is nearer to its remesh than any scanned
/// surface; there unlifted Butterfly loses up to 0.16 dB.) `coarse`: the last level but one, whose edges the finest
/// vertices lie on; `diagonal`: of the bounding box. At least 16 bits and at most 24, which flat meshes have. O(N).
int sufficient_precision(const SubdivisionLevel& coarse, const std::vector<Vec3>& positions, double diagonal);

}  // namespace gsp
