#include "remesh/fold_guard.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"

using namespace gsp;

namespace {

/// A flat fan of six faces around vertex 0, and the areas of its own faces as those of the surface.
struct Fan {
  Mesh mesh = shapes::sector_disc(6, 0);
  SubdivisionLevel level = base_level(mesh.vertex_count(), mesh.faces);
  std::vector<Vec3> areas;

  Fan() {
    for (const Triangle& t : mesh.faces) areas.push_back(doubled_area(t, mesh.positions));
  }
  std::vector<char> held(const std::vector<Vec3>& after) const {
    std::vector<char> held(mesh.positions.size(), 0);
    const bool any = FoldGuard(level, areas).hold(mesh.positions, after, held);
    CHECK(any == (std::count(held.begin(), held.end(), 1) > 0));
    CHECK_FALSE(FoldGuard(level, areas).hold(mesh.positions, after, held));
    return held;
  }
};

}  // namespace

TEST_CASE("the guard lets a vertex move as far as no face turns, and holds the corners of those that do") {
  const Fan fan;
  int centre = 0;
  for (int v = 0; v < fan.mesh.vertex_count(); ++v)
    if (fan.mesh.positions[v].norm() < 1e-12) centre = v;
  std::vector<Vec3> after = fan.mesh.positions;
  after[centre] = Vec3(0.4, 0.3, 0.0);
  CHECK(fan.held(after) == std::vector<char>(7, 0));
  // Over the middle of a side, 30 degrees off: out of the fan through one face, which alone turns.
  after[centre] = Vec3(std::cos(M_PI / 6.0), std::sin(M_PI / 6.0), 0.0);
  const std::vector<char> held = fan.held(after);
  CHECK(held[centre] == 1);
  CHECK(std::count(held.begin(), held.end(), 1) >= 3);
}

TEST_CASE("the guard holds what makes an edge fold, though no face turns against the surface") {
  const Fan fan;
  std::vector<Vec3> after = fan.mesh.positions;
  const auto centre =
      std::min_element(after.begin(), after.end(), [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
  *centre = Vec3(0.0, 0.0, 10.0);
  // Neighbours of a six-sided spike are 60 degrees apart, so it may stand.
  CHECK(fan.held(after) == std::vector<char>(7, 0));
  // Squeezed to a blade it may not.
  for (Vec3& p : after) p.y() *= 0.05;
  const std::vector<char> held = fan.held(after);
  CHECK(std::count(held.begin(), held.end(), 1) >= 4);
}

TEST_CASE("what was turned or folded before may stay so") {
  Fan fan;
  for (Vec3& a : fan.areas) a = -a;
  std::vector<Vec3> after = fan.mesh.positions;
  for (Vec3& p : after) p.x() += 0.1 * p.y();
  CHECK(fan.held(after) == std::vector<char>(7, 0));
}
