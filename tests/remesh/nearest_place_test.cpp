#include "remesh/nearest_place.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"

using namespace gsp;

namespace {

Mesh sphere(int halvings) {
  Mesh mesh = shapes::icosahedron();
  for (int i = 0; i < halvings; ++i) mesh = shapes::quadrisect(mesh);
  for (Vec3& p : mesh.positions) p.normalize();
  return mesh;
}

SubdivisionLevel level_of(const Mesh& mesh) { return base_level(mesh.vertex_count(), mesh.faces); }

Vec3 random_direction(Random& random) {
  return Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5).normalized();
}

/// The least over all faces, each from a walk that cannot leave it.
double nearest_of_all(const Mesh& mesh, const Vec3& point) {
  double least = HUGE_VAL;
  for (const Triangle& t : mesh.faces) {
    const std::vector<Vec3> corners = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    LevelPlace place;
    least = std::min(least, walk_to_nearest(base_level(3, {{0, 1, 2}}), corners, point, place));
  }
  return least;
}

}  // namespace

TEST_CASE("the nearest place of a triangle: inside, along its sides and at its corners") {
  const std::vector<Vec3> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const SubdivisionLevel level = base_level(3, {{0, 1, 2}});
  const auto nearest = [&](const Vec3& point, const Vec3& expected) {
    LevelPlace place;
    const double squared = walk_to_nearest(level, corners, point, place);
    CHECK((place.at(level, corners) - expected).norm() < 1e-15);
    CHECK(squared == Approx((point - expected).squaredNorm()));
    CHECK(place.weights[0] + place.weights[1] + place.weights[2] == Approx(1.0));
  };
  nearest({0.5, 0.5, 3.0}, {0.5, 0.5, 0.0});
  nearest({1.0, -1.0, 1.0}, {1.0, 0.0, 0.0});
  nearest({-1.0, 1.5, 1.0}, {0.0, 1.5, 0.0});
  nearest({2.0, 2.0, 0.0}, {1.0, 1.0, 0.0});
  nearest({-1.0, -2.0, 0.0}, {0.0, 0.0, 0.0});
  nearest({4.0, 1.0, 0.0}, {2.0, 0.0, 0.0});
  nearest({1.0, 4.0, 0.0}, {0.0, 2.0, 0.0});
}

// From the far side of a sphere a face whose middle is over the point is as near as any beside it.
TEST_CASE("from outside a sphere walks over its near half end at the nearest of all places") {
  const Mesh mesh = sphere(2);
  const SubdivisionLevel level = level_of(mesh);
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 point = (1.0 + 0.2 * random.uniform()) * random_direction(random);
    LevelPlace place;
    do place.face = static_cast<int>(random.uniform() * level.face_count());
    while (mesh.positions[mesh.faces[place.face][0]].dot(point) < 0.5);
    const double squared = walk_to_nearest(level, mesh.positions, point, place);
    CHECK(squared == Approx(nearest_of_all(mesh, point)).epsilon(1e-12).margin(1e-30));
    CHECK(squared == Approx((place.at(level, mesh.positions) - point).squaredNorm()).margin(1e-30));
  }
}

TEST_CASE("where a walk from between faces ends does not depend on the face it starts in") {
  // A valley: a point over it is as near to both sides.
  const std::vector<Vec3> positions = {{0, 0, 0}, {0, 2, 0}, {-2, 1, 2}, {2, 1, 2}};
  const SubdivisionLevel level = base_level(4, {{0, 1, 2}, {1, 0, 3}});
  const Vec3 nearer_to_first(-0.01, 1.0, 1.0);
  for (const LevelPlace& start : {LevelPlace{0, {0.5, 0.5, 0.0}}, LevelPlace{1, {0.5, 0.5, 0.0}}}) {
    LevelPlace place = start;
    walk_to_nearest(level, positions, nearer_to_first, place);
    CHECK(place.face == 0);
    CHECK(place.inside_face());
  }
}

TEST_CASE("a walk along a boundary goes round its vertices both ways") {
  const Mesh mesh = shapes::sector_disc(5, 2);
  const SubdivisionLevel level = level_of(mesh);
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Vec3 point = 1.5 * random_direction(random);
    LevelPlace place;
    place.face = static_cast<int>(random.uniform() * level.face_count());
    CHECK(walk_to_nearest(level, mesh.positions, point, place) ==
          Approx(nearest_of_all(mesh, point)).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("faces without area are walked as their edges") {
  std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  const SubdivisionLevel level = base_level(3, {{0, 1, 2}});
  LevelPlace place;
  CHECK(walk_to_nearest(level, corners, {2.0, 1.0, 0.0}, place) == Approx(1.0));
  corners = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  CHECK(walk_to_nearest(level, corners, {1.0, 1.0, 3.0}, place) == Approx(4.0));
}
