#pragma once

#include <optional>

#include "mesh/mesh.h"

namespace gsp {

/// From where a surface is seen; what is not given is chosen from the surface.
struct View {
  std::optional<Vec3> toward;  ///< direction from the surface to the eye, any length but 0
  std::optional<Vec3> up;      ///< what points up in the picture, as far as `toward` allows
};

/// An orthonormal frame: right, up, and toward the eye.
struct Camera {
  Vec3 right, up, toward;
};

/// Up is the coordinate axis along which the surface stands broadest, as scans of things that stand do. The eye looks
/// along the principal axis of least variance (over area), where the surface is broadest, turned a little aside and up
/// so that depth shows. Throws Error(BadOption) where a given direction has no length or `up` is parallel to `toward`.
/// O(V + F).
Camera make_camera(const Mesh& mesh, const View& view);

}  // namespace gsp
