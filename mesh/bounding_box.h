#pragma once

#include <Eigen/Geometry>

#include "mesh/mesh.h"

namespace gsp {

/// The axis-aligned box of all vertices that a face uses; empty for a mesh without faces. O(F).
Eigen::AlignedBox3d bounding_box(const Mesh& mesh);

}  // namespace gsp
