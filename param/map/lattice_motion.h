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

/// The lattice motion that takes two points, of any position, to two others up to `tolerance` (chart units); nothing
/// where none does.
inline std::optional<Transition> lattice_motion_within(double tolerance, Complex a, Complex b, Complex a_there,
                                                       Complex b_there) {
  for (int k = 0; k < 6; ++k) {
    const Complex turned_a = omega_power(k) * a;
    if (std::abs((b_there - a_there) - omega_power(k) * (b - a)) > tolerance) continue;
    const Eisenstein shift = nearest_lattice_point(a_there - turned_a);
    if (std::abs(shift.value() - (a_there - turned_a)) <= tolerance) return Transition{k, shift};
  }
  return std::nullopt;
}

}  // namespace gsp
