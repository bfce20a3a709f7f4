#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "remesh/semiregular.h"

namespace gsp {

/// Columns: unit normal, unit tangent along the edge, their cross product. Orthonormal.
using Frame = Eigen::Matrix3d;

/// How a frame's normal follows from the positions.
enum class FrameRule : std::uint8_t {
  /// A continuous function of the positions: of two faces that lie on each other the first has more weight, a face of
  /// hardly any area has less. Encoder and decoder, whose positions differ by rounding, have the same frames.
  Steady,
  /// The mean of both normals, whatever it is: where faces lie on each other, as in flat parts, its direction is the
  /// rounding's. Of streams up to version 7.
  Mean
};

/// One frame per edge of a level, from its vertices' positions: the normal of the edge's faces and the edge direction
/// made orthogonal to it. Degenerate geometry falls back on fixed axes, so frames are always orthonormal.
class EdgeFrames {
 public:
  /// Keeps references to both. O(F).
  EdgeFrames(const SubdivisionLevel& level, const std::vector<Vec3>& positions, FrameRule rule = FrameRule::Steady);

  Frame operator()(int edge) const;

 private:
  const SubdivisionLevel& level_;
  const std::vector<Vec3>& positions_;
  FrameRule rule_;
  std::vector<Vec3> normals_;  ///< #F, unit or shorter
};

}  // namespace gsp
