#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// The largest distance between the points of the same index; the test ends where there are not as many.
inline double worst(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  REQUIRE(a.size() == b.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

}  // namespace gsp
