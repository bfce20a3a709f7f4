#pragma once

#include <vector>

#include <Eigen/Core>

#include "remesh/semiregular.h"

namespace gsp {

/// Columns: unit normal, unit tangent along the edge, their cross product. Orthonormal.
using Frame = Eigen::Matrix3d;

/// One frame per edge of a level, from its vertices' positions: the mean normal of the edge's faces and the edge
/// direction made orthogonal to it. Degenerate geometry falls back on fixed axes, so frames are always orthonormal.
class EdgeFrames {
 public:
  /// Keeps references to both. O(F).
  EdgeFrames(const SubdivisionLevel& level, const std::vector<Vec3>& positions);

  Frame operator()(int edge) const;

 private:
  const SubdivisionLevel& level_;
  const std::vector<Vec3>& positions_;
  std::vector<Vec3> normals_;  ///< #F, unit or zero
};

}  // namespace gsp
