#pragma once

#include <optional>

#include "param/map/lattice.h"

namespace gsp {

/// The lattice motion that takes two lattice points, given to rounding, to two others; nothing where they are not as
/// far apart.
inline std::optional<Transition> lattice_motion(Complex a, Complex b, Complex a_there, Complex b_there) {
  const Eisenstein from = nearest_lattice_point(a), to = nearest_lattice_point(a_there);
  const Eisenstein along = nearest_lattice_point(b) - from, along_there = nearest_lattice_point(b_there) - to;
  for (int k = 0; k < 6; ++k)
    if (rotate(along, k) == along_there) return Transition{k, to - rotate(from, k)};
  return std::nullopt;
}

}  // namespace gsp
