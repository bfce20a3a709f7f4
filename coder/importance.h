#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "coder/edge_forest.h"
#include "remesh/filters/local_frames.h"
#include "remesh/semiregular.h"

namespace gsp {

/// How much earlier than a normal detail on a flat mesh of equal triangles each node's bits are worth sending
/// (bitplane_coder.h). To first order a displacement along the axis f moves the surface by ∫(n·f)² dA over its support:
/// so steps should go with the inverse square root of f's second moment of normals there. For tangential components
/// this is next to nothing where the surface is flat and smooth, and as much as for normal ones where it is neither;
/// they count for at least 1/`tangential_ratio`, since what is not known yet may bend the surface. `positions`
/// are the decoder's own of levels 0 to at most forest.levels(); nodes of the finest of these levels
/// and beyond take what their parents have.
class SurfaceUrgency {
 public:
  /// Keeps references to `levels` and `forest`. O(positions).
  SurfaceUrgency(const std::vector<SubdivisionLevel>& levels, const EdgeForest& forest,
                 std::vector<std::vector<Vec3>> positions, int tangential_ratio, FrameRule rule);
  SurfaceUrgency(const SurfaceUrgency&) = delete;

  /// Of normal, first and second tangential component.
  std::array<std::int8_t, 3> of(int node) const;

  /// A symmetric matrix: xx, yy, zz, xy, xz, yz.
  using Moment = Eigen::Matrix<double, 6, 1>;

 private:
  const std::vector<SubdivisionLevel>& levels_;
  const EdgeForest& forest_;
  std::vector<std::vector<Vec3>> positions_;
  double least_;
  int finest_;
  std::vector<std::vector<Moment>> moments_;  ///< of each face of the levels before the finest
  double total_ = 0.0;                        ///< area
  std::vector<EdgeFrames> frames_;            ///< of the same levels
};

}  // namespace gsp
