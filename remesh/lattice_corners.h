#pragma once

#include <array>

namespace gsp {

/// Lattice coordinates, weights of corners 1 and 2 times 2^level, of the three corners of face `index` among those that
/// quadrisecting a base face makes, by the numbering rule of semiregular.h.
inline std::array<std::array<int, 2>, 3> lattice_corners(int level, int index) {
  const int n = 1 << level;
  std::array<std::array<int, 2>, 3> c = {{{0, 0}, {n, 0}, {0, n}}};
  for (int l = level - 1; l >= 0; --l) {
    const auto middle = [&](int a, int b) {
      return std::array<int, 2>{(c[a][0] + c[b][0]) / 2, (c[a][1] + c[b][1]) / 2};
    };
    const auto ab = middle(0, 1), bc = middle(1, 2), ca = middle(2, 0);
    switch ((index >> (2 * l)) & 3) {
      case 0:
        c = {c[0], ab, ca};
        break;
      case 1:
        c = {ab, c[1], bc};
        break;
      case 2:
        c = {ca, bc, c[2]};
        break;
      default:
        c = {ab, bc, ca};
    }
  }
  return c;
}

}  // namespace gsp
