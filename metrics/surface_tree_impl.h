#pragma once

#include "mesh/nearest/triangle_tree.h"
#include "metrics/surface_distance.h"

namespace gsp {

struct SurfaceTree::Impl {
  TriangleTree tree;
};

}  // namespace gsp
