#pragma once

#include <array>
#include <functional>

#include "experiments/figures/camera.h"
#include "experiments/figures/image.h"
#include "mesh/mesh.h"

namespace gsp {

/// A point of the surface that one sample of the picture shows.
struct Fragment {
  int face = 0;
  std::array<double, 3> weights;  ///< barycentric, of the face's corners
  /// How each weight changes per pixel to the right and down: with it paint draws lines of a width in pixels.
  std::array<Eigen::Vector2d, 3> slopes;
};

/// The surface's own colour at a fragment, before light. Called from any thread.
using Paint = std::function<Colour(const Fragment&)>;

struct RenderOptions {
  int size = 1200;     ///< pixels of the longer side, 16..8192; the other follows the surface
  bool smooth = true;  ///< light by normals interpolated between vertices, otherwise by each face's own
};

/// Orthographic picture of a surface on white: hidden surfaces removed with a depth buffer, nine samples a pixel, one
/// light from the upper left and a weak one from the right. Insides of open surfaces are shown darker. The same bytes
/// for any number of threads. O(F + pixels). Throws Error: BadOption, those of `require_finite_surface`.
Image render(const Mesh& mesh, const Camera& camera, const Paint& paint, const RenderOptions& options);

/// 1 where faces are counter-clockwise seen from outside, as they should be; -1 for a surface that is inside out: its
/// volume, or for an open one that of the cone to the middle of its faces, is negative. O(F).
double orientation(const Mesh& mesh);

/// Share in [0, 1] of ink where a function, linear on the face with these values at its corners, is within half of
/// `width` pixels of an integer. Lines closer than a few pixels fade into the tint they would average to.
double line_ink(const std::array<double, 3>& values, const Fragment& fragment, double width);

}  // namespace gsp
