#pragma once

#include <array>

#include "mesh/mesh.h"

namespace gsp {

/// Where on the surface a point of a chart lies: in a face, at the weights of its three corners.
struct SurfacePoint {
  int face = -1;  ///< -1: none found
  /// To choose among several faces: the smallest weight; less `kFlipped` in a flipped face; less `kNear` where the face
  /// does not hold the point but is near it.
  double fit = 0.0;
  std::array<double, 3> weights = {0.0, 0.0, 0.0};

  static constexpr double kFlipped = 4.0;
  static constexpr double kNear = 8.0;

  bool better_than(const SurfacePoint& other) const {
    if (face < 0 || other.face < 0) return face >= 0;
    return fit != other.fit ? fit > other.fit : face < other.face;
  }
};

/// Weights brought into the triangle, those on its border exactly.
std::array<double, 3> snapped_weights(std::array<double, 3> weights);

/// Of a point that is known to lie on a crease, along edges of the surface: on an edge or a corner of its face exactly.
SurfacePoint on_crease(SurfacePoint point);

/// Where that is; exact on vertices.
Vec3 position_at(const Mesh& surface, const SurfacePoint& point);

}  // namespace gsp
