#pragma once

#include "metrics/surface_distance.h"
#include "metrics/triangle_tree.h"

namespace gsp {

struct SurfaceTree::Impl {
  TriangleTree tree;
};

}  // namespace gsp
