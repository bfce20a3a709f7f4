#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numeric>

#include "mesh/error.h"
#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/parameterize.h"
#include "param/simplify/removal_order.h"
#include "param/simplify/removal_script.h"
#include "param/simplify/simplify.h"
#include "param_checks.h"

using namespace gsp;

namespace {

StarShape shape_at(const Mesh& mesh, int vertex) {
  const Surface surface(mesh);
  const TriangleComplex complex(surface);
  Star star;
  complex.gather(vertex, star);
  return star_shape(star, mesh.positions);
}

/// How many of the first removals have no neighbour among those before them.
int independent_at_first(const Surface& surface, const RemovalScript& removals) {
  std::vector<char> gone(surface.mesh.positions.size(), 0);
  int count = 0;
  for (; count < removals.size(); ++count) {
    bool beside = false;
    surface.for_each_neighbour(removals.vertex(count), [&](int w, int, bool) { beside = beside || gone[w]; });
    if (beside) break;
    gone[removals.vertex(count)] = 1;
  }
  return count;
}

}  // namespace

TEST_CASE("area and curvature of a star are those of the shape") {
  // Four equilateral triangles with side √2; each edge has the dihedral angle acos(1/3).
  const StarShape corner = shape_at(shapes::octahedron(), 0);
  CHECK(corner.area == Approx(2.0 * std::sqrt(3.0)));
  CHECK(corner.curvature == Approx(4.0 * std::sqrt(2.0) * 0.5 * std::acos(1.0 / 3.0) / (corner.area / 3.0)));
  // |κ1| + |κ2| of a sphere of radius 2 is 1, up to the triangles' size.
  CHECK(shape_at(shapes::sphere(4, 2.0), 300).curvature == Approx(1.0).epsilon(0.01));
  const Mesh flat = shapes::grid(4, 4);
  const StarShape inside = shape_at(flat, 12), side = shape_at(flat, 2), at_corner = shape_at(flat, 0);
  CHECK(inside.area == Approx(3.0));
  CHECK(inside.curvature == Approx(0.0).margin(1e-12));
  CHECK(side.curvature == Approx(0.0).margin(1e-12));
  // A right angle over half of two unit edges.
  CHECK(at_corner.curvature == Approx(std::acos(0.0)));
}

TEST_CASE("a star without area has no curvature") {
  Mesh mesh = shapes::octahedron();
  for (Vec3& p : mesh.positions) p = Vec3(1.0, 2.0, 3.0);
  const StarShape shape = shape_at(mesh, 0);
  CHECK(shape.area == 0.0);
  CHECK(shape.curvature == 0.0);
}

TEST_CASE("chance moves a price by at most 1e-4, and no price of replicate 0") {
  CHECK(factor_of_chance(0, 7) == 1.0);
  for (int v = 0; v < 100; ++v) CHECK(std::abs(factor_of_chance(3, v) - 1.0) <= 1e-4);
  CHECK(factor_of_chance(1, 7) != factor_of_chance(2, 7));
  CHECK(factor_of_chance(1, 7) != factor_of_chance(1, 8));
  CHECK(factor_of_chance(1, 7) == factor_of_chance(1, 7));
}

TEST_CASE("a round takes small, flat stars first, and neighbours of what went in the next round") {
  Mesh mesh = shapes::grid(6, 6);
  const int side = 2, flat = 8, inside = 3 * 7 + 3, beside = inside + 1;
  mesh.positions[inside].z() = 1.0;  // a tip
  const Surface surface(mesh);
  const TriangleComplex complex(surface);
  std::vector<int> all(mesh.positions.size());
  std::iota(all.begin(), all.end(), 0);
  MapsOrder order(complex, mesh.positions, 0);
  order.begin_round(all);
  CHECK(order.price(side) < order.price(flat));
  CHECK(order.price(flat) < order.price(inside));
  CHECK(order.is_due(order.price(inside)));
  order.hold(beside);
  CHECK_FALSE(order.is_due(order.price(beside)));
  CHECK(order.price(beside) > order.price(inside));
  order.begin_round(all);
  CHECK(order.is_due(order.price(beside)));
}

TEST_CASE("a vertex of a valence over 12 waits") {
  const Mesh disc = shapes::sector_disc(13, 1);
  const Surface surface(disc);
  const TriangleComplex complex(surface);
  std::vector<int> all(disc.positions.size());
  std::iota(all.begin(), all.end(), 0);
  MapsOrder order(complex, disc.positions, 0);
  order.begin_round(all);
  CHECK_FALSE(order.is_due(order.price(0)));
  CHECK(order.is_due(order.price(1)));
}

TEST_CASE("a script places its triangles in a ring, wherever that starts") {
  RemovalScript script;
  script.add(9, {{4, 5, 6}, {6, 7, 4}});
  script.add(8, {{1, 2, 3}});
  REQUIRE(script.size() == 2);
  CHECK(script.vertex(1) == 8);
  const Star star{9, false, {6, 7, 4, 5}, {0, 1, 2, 3}};
  CHECK(in_ring(star, {4, 5, 6}) == RingTriangle{0, 2, 3});
  Removal made{-1, {{7, 7, 7}}};
  script.place(0, star, made);
  CHECK(made.vertex == 9);
  CHECK(made.triangles == std::vector<RingTriangle>{{0, 2, 3}, {0, 1, 2}});
}

TEST_CASE("MAPS' priority removes independent sets, down to the base that was asked for") {
  const auto surface = std::make_shared<const Surface>(spiky_sphere(4));
  ParameterizeOptions options;
  options.base_vertices = 12;
  Progress progress;
  const auto first = [&] {
    return independent_at_first(*surface, simplify(surface, options, 1 << 30, progress).removals);
  };
  const int vertices = surface->mesh.vertex_count();
  CHECK(first() < vertices / 8);
  options.priority = Priority::Maps;
  CHECK(first() > vertices / 6);
  const SimplifyResult made = simplify(surface, options, 1 << 30, progress);
  CHECK(remaining_vertices(*surface, made.removals).size() == 12);
  CHECK(find_folds(made.map->coarsened().atlas).none());
}

TEST_CASE("a base by MAPS' priority carries every method's map, and wants a number of vertices") {
  ParameterizeOptions options;
  options.priority = Priority::Maps;
  options.base_vertices = 12;
  Progress progress;
  const Mesh torus = shapes::torus(30, 12);
  for (Method method : kMethods) {
    options.method = method;
    CHECK(parameterize(torus, options, progress).map.base.vertex_count() == 12);
  }
  options.base_vertices = kBaseByOmega;
  CHECK_THROWS_AS(parameterize(torus, options, progress), Error);
}
