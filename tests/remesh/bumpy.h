#pragma once

#include <catch2/catch.hpp>

#include "mesh/random.h"
#include "remesh/remesh.h"
#include "tests/support/exact_maps.h"

namespace gsp {

/// A remesh of which nothing is noted.
inline SemiregularMesh remeshed(const Parameterization& map, int level, Positions positions) {
  Progress progress;
  progress.on_note([](const std::string& note) { FAIL_CHECK(note); });
  return remesh(map, {level, positions}, progress);
}

/// The base quadrisected, under a valid map that crosses base edges, each vertex lifted at random by up to `height` in
/// each coordinate.
inline Parameterization bumpy(const Mesh& base, int level, double height = 0.01) {
  Parameterization map = exact_maps::quadrisected(base, level);
  exact_maps::jitter(map, 0.19, level, 5);
  Random random(3);
  for (Vec3& p : map.surface.positions) p += height * Vec3(random.uniform(), random.uniform(), random.uniform());
  return map;
}

}  // namespace gsp
