#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/nearest_place.h"
#include "remesh/remesh.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

constexpr int kMapLevel = 3;

/// The octahedron, refined, whose equator is a crease that the map does not run evenly along.
struct Equator {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), kMapLevel);
  std::vector<std::array<int, 2>> edges;  ///< of the surface, along the crease

  Equator() {
    for (const auto& [a, b] : base_level(map.base.vertex_count(), map.base.faces).edges)
      if (on(map.base.vertices[a]) && on(map.base.vertices[b]))
        map.base.creases.push_back({std::min(a, b), std::max(a, b)});
    std::sort(map.base.creases.begin(), map.base.creases.end());
    for (const auto& [a, b] : base_level(map.surface.vertex_count(), map.surface.faces).edges)
      if (on(a) && on(b)) edges.push_back({a, b});
    exact_maps::jitter_along_edges(map, 0.19, kMapLevel, 4);
  }

  bool on(int v) const { return std::abs(map.surface.positions[v].z()) < 1e-12; }

  double distance(const Vec3& p) const {
    double least = 1e300;
    for (const auto& [a, b] : edges) {
      const Vec3 from = map.surface.positions[a], side = map.surface.positions[b] - from;
      const double t = std::clamp((p - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - from - t * side).norm());
    }
    return least;
  }
};

SemiregularMesh remeshed(const Parameterization& map, RemeshKind kind, Positions positions, int level) {
  Progress progress;
  RemeshOptions options;
  options.level = level;
  options.positions = positions;
  options.kind = kind;
  return remesh(map, options, progress);
}

/// A lens that bulges by `above` and `below`.
Equator lens(double above, double below) {
  Equator equator;
  for (Vec3& p : equator.map.surface.positions) {
    const double height = p.z(), angle = std::atan2(p.y(), p.x()), radius = 1.0 - std::abs(height);
    p = {radius * std::cos(angle), radius * std::sin(angle), (height > 0 ? above : -below) * (1.0 - radius * radius)};
  }
  return equator;
}

std::vector<int> crease_vertices(const SemiregularMesh& mesh) {
  const auto fans = vertex_fans(mesh.levels().back());
  std::vector<int> on;
  for (int v = 0; v < static_cast<int>(fans.size()); ++v)
    if (fans[v].on_crease()) on.push_back(v);
  return on;
}

}  // namespace

TEST_CASE("the points of a crease lie on the surface's edges along it, to rounding, in every kind of remesh") {
  Equator equator;
  REQUIRE(equator.edges.size() == 4u << kMapLevel);
  Random random(7);
  for (Vec3& p : equator.map.surface.positions) p += 0.1 * Vec3(random.uniform(), random.uniform(), random.uniform());
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (RemeshKind kind : {RemeshKind::Parametric, RemeshKind::Normal}) {
      const SemiregularMesh mesh = remeshed(equator.map, kind, Positions::Sampled, 5);
      CHECK(mesh.creases == equator.map.base.creases);
      const std::vector<int> on = crease_vertices(mesh);
      CHECK(on.size() == 4 * 32);
      double farthest = 0.0;
      for (int v : on) farthest = std::max(farthest, equator.distance(mesh.positions[v]));
      CHECK(farthest < 1e-15);
    }
    exact_maps::rechart(equator.map, seed);
  }
}

TEST_CASE("a fitted crease is a curve of its own, whatever lies beside it, and nearer to it than samples are") {
  const Equator low = lens(0.5, 0.5), high = lens(1.5, 0.5);
  for (Positions positions : {Positions::Fitted, Positions::Closest}) {
    const SemiregularMesh a = remeshed(low.map, RemeshKind::Parametric, positions, 2);
    const SemiregularMesh b = remeshed(high.map, RemeshKind::Parametric, positions, 2);
    const SemiregularMesh sampled = remeshed(low.map, RemeshKind::Parametric, Positions::Sampled, 2);
    double fitted_error = 0.0, sampled_error = 0.0;
    const auto error = [&](const SemiregularMesh& mesh, const std::array<int, 2>& ends) {
      double sum = 0.0;
      for (int s = 0; s < 8; ++s) {
        const double t = (s + 0.5) / 8;
        const double d = low.distance((1 - t) * mesh.positions[ends[0]] + t * mesh.positions[ends[1]]);
        sum += d * d;
      }
      return sum;
    };
    const SubdivisionLevel finest = a.levels().back();
    for (int e = 0; e < finest.edge_count(); ++e) {
      if (!finest.creased[e]) continue;
      for (int v : finest.edges[e]) {
        CHECK(a.positions[v] == b.positions[v]);
        CHECK(std::abs(a.positions[v].z()) < 1e-12);
      }
      fitted_error += error(a, finest.edges[e]);
      sampled_error += error(sampled, finest.edges[e]);
    }
    CHECK(fitted_error < 0.5 * sampled_error);
  }
}

TEST_CASE("the end of a crease, and where creases meet, stays where the surface has it") {
  Equator equator = lens(0.5, 0.5);
  // Three of the four edges of the equator, and one that goes up from the middle of them.
  Creases& creases = equator.map.base.creases;
  const Triangle& up = equator.map.base.faces[0];
  creases.erase(creases.begin());
  for (const auto& [a, b] : {std::pair{up[0], up[1]}, std::pair{up[1], up[2]}})
    if (std::find(creases.begin(), creases.end(), std::array{std::min(a, b), std::max(a, b)}) == creases.end())
      creases.push_back({std::min(a, b), std::max(a, b)});
  std::sort(creases.begin(), creases.end());
  const SemiregularMesh mesh = remeshed(equator.map, RemeshKind::Parametric, Positions::Fitted, 3);
  const auto fans = vertex_fans(mesh.levels().front());
  int corners = 0;
  for (int v = 0; v < mesh.base_vertices; ++v) {
    if (fans[v].crease_count == 0 || fans[v].on_curve()) continue;
    ++corners;
    CHECK(mesh.positions[v] == equator.map.surface.positions[equator.map.base.vertices[v]]);
  }
  CHECK(corners > 0);
}

TEST_CASE("a crease that turns at once has a corner there, which stays, and one that goes around has none") {
  const Equator square, round = lens(0.5, 0.5);
  for (RemeshKind kind : {RemeshKind::Parametric, RemeshKind::Normal}) {
    const SemiregularMesh mesh = remeshed(square.map, kind, Positions::Fitted, 3);
    CHECK(mesh.corners.size() == 4);
    if (kind == RemeshKind::Parametric)
      for (int v : mesh.corners) CHECK(mesh.positions[v] == square.map.surface.positions[square.map.base.vertices[v]]);
    CHECK(remeshed(round.map, kind, Positions::Sampled, 3).corners.empty());
  }
}

TEST_CASE("the walk to the nearest place ends at a crease") {
  const std::vector<Triangle> faces = {{0, 1, 2}, {1, 0, 3}};
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3 point(0.25, -0.1, 0.25);
  for (const bool creased : {false, true}) {
    const SubdivisionLevel level = base_level(4, faces, creased ? Creases{{0, 1}} : Creases{});
    LevelPlace place{0, {0.4, 0.3, 0.3}};
    const double squared = walk_to_nearest(level, positions, point, place);
    CHECK(place.face == (creased ? 0 : 1));
    CHECK(squared == Approx(creased ? 0.01 + 0.0625 : 0.01));
  }
}
