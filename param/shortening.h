#pragma once

#include "mesh/mesh.h"

namespace gsp {

/// A surface that is much longer than it is wide, and whose faces are long with it, pressed together along its length.
/// A map of the image is one of the surface, with patches that are as long for their width as the surface is: patches
/// near to equilateral would be so many that faces had to be split without end for them.
class Shortening {
 public:
  /// The direction of greatest extent, and how far to press along it: as far as half of the faces want it to become as
  /// wide as long, but the image stays several times as long as it is wide. O(V + F).
  explicit Shortening(const Mesh& mesh);

  /// Whether there is anything to be done.
  bool any() const { return factor_ < 1.0; }
  /// The image, and back. Coordinates come back to rounding.
  void press(Mesh& mesh) const { scale(mesh, factor_); }
  void draw_out(Mesh& mesh) const { scale(mesh, 1.0 / factor_); }

 private:
  void scale(Mesh& mesh, double factor) const;

  Vec3 middle_ = Vec3::Zero(), axis_ = Vec3::UnitX();
  double factor_ = 1.0;
};

}  // namespace gsp
