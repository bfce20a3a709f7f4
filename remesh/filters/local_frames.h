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
  /// By the faces' areas, so that a thin face, whose normal turns with the least move of a corner, hardly counts: the
  /// frames of a prefix are near those of the whole stream. Of two faces that lie on each other the first has more
  /// weight. Continuous, so that encoder and decoder, whose positions differ by rounding, have the same frames.
  ByArea,
  /// Both faces alike, but for those of hardly any area; continuous too. Of streams of version 8.
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
  EdgeFrames(const SubdivisionLevel& level, const std::vector<Vec3>& positions, FrameRule rule = FrameRule::ByArea);

  Frame operator()(int edge) const;

 private:
  const SubdivisionLevel& level_;
  const std::vector<Vec3>& positions_;
  FrameRule rule_;
  struct FaceNormal {
    Vec3 vector;
    double length;  ///< at least that of the vector: more where the face is thin
  };
  std::vector<FaceNormal> normals_;  ///< #F
};

}  // namespace gsp
