#pragma once

#include <optional>
#include <vector>

#include "param/map/lattice.h"

namespace gsp {

/// The places in a polygon from which all of its border is seen.
struct Kernel {
  const std::vector<Complex>& border;  ///< counter-clockwise
  bool open;                           ///< the side from the last vertex to the first is to hold the vertex

  /// Thickness of the thinnest of the triangles between a place and the sides; not positive where it does not see all.
  double least_thickness(Complex at) const;
  /// The place wanted, or one deeper inside where that is too near to the border. Nothing where no place sees enough.
  std::optional<Complex> place(Complex wanted) const;
  /// The same on the open side, at a share of the way from the last vertex to the first.
  std::optional<Complex> place_on_chord(double wanted) const;
};

}  // namespace gsp
