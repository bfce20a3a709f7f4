#include "remesh/fit_positions.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/chart_samples.h"
#include "remesh/remesh.h"
#include "tests/by_threads.h"
#include "tests/remesh/bumpy.h"
#include "tests/remesh/worst.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// The faces between the vertices, as points `halvings` levels finer.
Mesh refined(const SemiregularMesh& coarse, int halvings) {
  Mesh mesh = coarse.mesh();
  for (int i = 0; i < halvings; ++i) mesh = shapes::quadrisect(mesh);
  return mesh;
}

/// A flat hexagon of side 1, its map the identity, lifted.
template <class Height>
Parameterization lifted_hexagon(int level, Height height) {
  Parameterization map = exact_maps::quadrisected(shapes::sector_disc(6, 0), level);
  for (Vec3& p : map.surface.positions) p.z() = height(p.x(), p.y());
  return map;
}

double paraboloid(double x, double y) { return 0.5 * (x * x + y * y); }
double saddle(double x, double y) { return 0.5 * (x * x - y * y); }

/// Root mean square of the height over that of a function, at the points.
template <class Height>
double height_error(const std::vector<Vec3>& points, Height height) {
  REQUIRE(!points.empty());
  double sum = 0.0;
  for (const Vec3& p : points) sum += std::pow(p.z() - height(p.x(), p.y()), 2);
  return std::sqrt(sum / points.size());
}

/// Random points, as many in each face, away from the boundary. A lattice of points would see the mean of the error,
/// which is nearly all of it, with an error of its own.
std::vector<Vec3> points_inside(const SemiregularMesh& remesh) {
  const Mesh mesh = remesh.mesh();
  Random random(1);
  std::vector<Vec3> points;
  for (const Triangle& t : mesh.faces) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    if (((a + b + c) / 3.0).head<2>().norm() > 0.5) continue;
    for (int i = 0; i < 1000; ++i) {
      const double root = std::sqrt(random.uniform()), u = random.uniform();
      points.push_back((1.0 - root) * a + root * (1.0 - u) * b + root * u * c);
    }
  }
  return points;
}

/// Points along one side, away from its ends, beyond which the boundary turns.
std::vector<Vec3> points_along_a_side(const SemiregularMesh& remesh) {
  const Vec3 normal(std::sqrt(0.75), 0.5, 0.0), side(-0.5, std::sqrt(0.75), 0.0);
  std::vector<Vec3> points;
  for (const Vec3& p : refined(remesh, 5).positions)
    if (std::abs(p.dot(normal) - std::sqrt(0.75)) < 1e-9 && std::abs(p.dot(side)) < 0.25 - 1e-9) points.push_back(p);
  return points;
}

/// What sampling loses over fitting.
template <class Height, class Points>
double sampled_over_fitted(Height height, Points points) {
  const Parameterization map = lifted_hexagon(7, height);
  const auto error = [&](Positions positions) { return height_error(points(remeshed(map, 3, positions)), height); };
  return error(Positions::Sampled) / error(Positions::Fitted);
}

/// Sum over the faces, by the quadrature of fits with four steps, of the squared distance to the surface over the same
/// places of the domain.
double domain_error(const Parameterization& map, const SemiregularMesh& mesh) {
  const Mesh faces = refined(mesh, 2);
  const std::vector<Vec3> surface = remeshed(map, mesh.level + 2, Positions::Sampled).positions;
  REQUIRE(surface.size() == faces.positions.size());
  double sum = 0.0;
  for (const Triangle& t : faces.faces)
    for (int v : t) sum += (faces.positions[v] - surface[v]).squaredNorm();
  return sum;
}

/// The projection alone, from samples of `map` four steps apart.
std::vector<Vec3> projected(const Parameterization& map, int level) {
  constexpr int kSteps = 4;
  const std::vector<Vec3> surface = remeshed(map, level + 2, Positions::Sampled).positions;
  const std::vector<SubdivisionLevel> levels = subdivision_levels(map.base.vertex_count(), map.base.faces, level + 2);
  // Lattice corners of the faces that quadrisecting one twice makes.
  using Corners = std::array<std::array<int, 2>, 3>;
  std::vector<Corners> pieces = {{{{0, 0}, {kSteps, 0}, {0, kSteps}}}};
  for (int halving = 0; halving < 2; ++halving) {
    std::vector<Corners> finer;
    for (const Corners& c : pieces) {
      const auto middle = [&](int a, int b) {
        return std::array<int, 2>{(c[a][0] + c[b][0]) / 2, (c[a][1] + c[b][1]) / 2};
      };
      const auto ab = middle(0, 1), bc = middle(1, 2), ca = middle(2, 0);
      for (const Corners& child : {Corners{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {ab, bc, ca}})
        finer.push_back(child);
    }
    pieces = finer;
  }
  PositionFit fit(levels[level], kSteps);
  for (int f = 0; f < levels[level].face_count(); ++f) {
    std::vector<Vec3> points((kSteps + 1) * (kSteps + 2) / 2);
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (int k = 0; k < 3; ++k)
        points[lattice_index(kSteps, pieces[p][k][0], pieces[p][k][1])] =
            surface[levels.back().faces[pieces.size() * f + p][k]];
    fit.add_face(f, points);
  }
  return fit.fit({surface.begin(), surface.begin() + levels[level].vertex_count});
}

}  // namespace

TEST_CASE("a linear map is fitted exactly: the plane, its boundary and its corners") {
  const auto slope = [](double x, double y) { return 3.0 + 0.25 * x - 0.5 * y; };
  const Parameterization map = lifted_hexagon(4, slope);
  for (Positions positions : {Positions::Fitted, Positions::Closest})
    for (int level = 0; level <= 5; ++level)
      CHECK(worst(remeshed(map, level, positions).positions, remeshed(map, level, Positions::Sampled).positions) <
            1e-14);
}

TEST_CASE("a flat surface stays flat whatever the map does") {
  Parameterization map = lifted_hexagon(4, [](double, double) { return 2.0; });
  exact_maps::jitter(map, 0.19, 4, 3);
  for (Positions positions : {Positions::Fitted, Positions::Closest})
    for (const Vec3& p : remeshed(map, 3, positions).positions) CHECK(p.z() == Approx(2.0).epsilon(1e-14));
}

// On a lattice of equilateral triangles with circumradius R the interpolation error of |x|²/2 is (R² - |x-c|²)/2, whose
// projection on the hat functions is its mean: with E|x-c|² = R²/4 and its variance the ratio is √(1/15 / (1/15 -
// 1/16)).
TEST_CASE("the fit is four times nearer to a paraboloid than sampling", "[slow]") {
  CHECK(sampled_over_fitted(paraboloid, points_inside) == Approx(4.0).epsilon(0.02));
}

// By the lattice's symmetry the error of a saddle has no mean.
TEST_CASE("of a saddle the samples are the fit already", "[slow]") {
  CHECK(sampled_over_fitted(saddle, points_inside) == Approx(1.0).epsilon(0.01));
}

// Along a parabola the error t (h - t) / 2 has mean h²/12 and mean square h⁴/120.
TEST_CASE("the boundary is fitted along itself, √6 times nearer to a parabola than sampling", "[slow]") {
  CHECK(sampled_over_fitted(paraboloid, points_along_a_side) == Approx(std::sqrt(6.0)).epsilon(0.02));
}

TEST_CASE("what lies inside has no part in the boundary's fit") {
  const Parameterization map = lifted_hexagon(5, paraboloid);
  Parameterization other = map;
  for (Vec3& p : other.surface.positions) p.z() += std::pow(std::max(0.0, 0.8 - p.head<2>().norm()), 2);
  const SemiregularMesh a = remeshed(map, 3, Positions::Fitted), b = remeshed(other, 3, Positions::Closest);
  const std::vector<VertexFan> fans = vertex_fans(subdivision_levels(a.base_vertices, a.base_faces, 3).back());
  int on_boundary = 0;
  for (std::size_t v = 0; v < fans.size(); ++v) {
    if (fans[v].sharp_count == 0) continue;
    ++on_boundary;
    CHECK(a.positions[v] == b.positions[v]);
  }
  CHECK(on_boundary == 6 * 8);
}

TEST_CASE("the fit is the least of its sum of squares at every level, whichever charts hold the faces") {
  for (const Mesh& base : {shapes::tetrahedron(), shapes::icosahedron(), shapes::lattice_torus(4, 5)})
    for (int level = 1; level <= 3; ++level) {
      // As fine as the remesh, so that four steps suffice.
      Parameterization map = bumpy(base, level);
      SemiregularMesh fitted = remeshed(map, level, Positions::Sampled);
      fitted.positions = projected(map, level);
      const double least = domain_error(map, fitted);
      CHECK(least <= domain_error(map, remeshed(map, level, Positions::Sampled)));
      Random random(level);
      for (int i = 0; i < 5; ++i) {
        SemiregularMesh moved = fitted;
        for (Vec3& p : moved.positions)
          p += 1e-3 * (Vec3(random.uniform(), random.uniform(), random.uniform()) - Vec3::Constant(0.5));
        CHECK(domain_error(map, moved) > least);
      }
      exact_maps::rechart(map, 9);
      CHECK(worst(fitted.positions, projected(map, level)) < 1e-12);
    }
}

TEST_CASE("no face turns against the surface over it but those whose samples do") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::lattice_torus(4, 5), shapes::grid(2, 3)}) {
    const Parameterization map = bumpy(base, 3, 0.3);
    const SemiregularMesh fitted = remeshed(map, 3, GENERATE(Positions::Fitted, Positions::Closest));
    const Mesh sampled = remeshed(map, 3, Positions::Sampled).mesh(),
               finer = remeshed(map, 5, Positions::Sampled).mesh();
    const auto area = [](const std::vector<Vec3>& p, const Triangle& t) -> Vec3 {
      return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
    };
    int steep = 0;
    for (int f = 0; f < sampled.face_count(); ++f) {
      Vec3 surface = Vec3::Zero();
      for (int child = 16 * f; child < 16 * f + 16; ++child) surface += area(finer.positions, finer.faces[child]);
      const double before = area(sampled.positions, sampled.faces[f]).dot(surface);
      CHECK((area(fitted.positions, sampled.faces[f]).dot(surface) > 0.0 || before < 1e-12));
      steep += before <= 0.0;
    }
    CHECK(steep > 0);
    CHECK(worst(fitted.positions, sampled.positions) > 0.01);
  }
}

TEST_CASE("a sphere: the fit is nearer by what its curvature, alike in all directions, allows", "[slow]") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 6);
  for (Vec3& p : map.surface.positions) p.normalize();
  const auto error = [&](Positions positions) {
    double sum = 0.0;
    const Mesh faces = refined(remeshed(map, 3, positions), 3);
    for (const Vec3& p : faces.positions) sum += (p.norm() - 1.0) * (p.norm() - 1.0);
    return std::sqrt(sum / faces.vertex_count());
  };
  // The triangles of the central projection are not equilateral, so less than the paraboloid's four.
  const double ratio = error(Positions::Sampled) / error(Positions::Fitted);
  CHECK(ratio > 3.0);
  CHECK(ratio < 4.0);
}

TEST_CASE("a rigid motion or mirror of the surface moves the fit") {
  const Positions positions = GENERATE(Positions::Fitted, Positions::Closest);
  const double sign = GENERATE(1.0, -1.0);
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(2, 3)}) {
    Parameterization map = bumpy(base, 3);
    std::vector<Vec3> expected = remeshed(map, 2, positions).positions;
    const Eigen::Matrix3d turn = sign * Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -2.0).normalized()).toRotationMatrix();
    const Vec3 shift(3.0, -5.0, 2.0);
    for (Vec3& p : map.surface.positions) p = turn * p + shift;
    for (Vec3& p : expected) p = turn * p + shift;
    CHECK(worst(remeshed(map, 2, positions).positions, expected) < 1e-11);
  }
}

TEST_CASE("a scaling of the surface scales the fit, by a power of two to the last bit") {
  const Positions positions = GENERATE(Positions::Fitted, Positions::Closest);
  Parameterization map = bumpy(shapes::icosahedron(), 3);
  std::vector<Vec3> expected = remeshed(map, 2, positions).positions;
  for (Vec3& p : map.surface.positions) p *= 0x1p-20;
  for (Vec3& p : expected) p *= 0x1p-20;
  CHECK(remeshed(map, 2, positions).positions == expected);
}

TEST_CASE("folds, and coordinates of any size that is taken, leave the fit finite") {
  const Positions positions = GENERATE(Positions::Fitted, Positions::Closest);
  for (double size : {1e-50, 1.0, 1e70}) {
    Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
    exact_maps::jitter(map, 1.2, 3, 3);
    for (Vec3& p : map.surface.positions) p *= size;
    Progress silent;
    for (const Vec3& p : remesh(map, {4, positions}, silent).positions) {
      CHECK(p.allFinite());
      CHECK(p.norm() < 2.0 * size);
    }
  }
}

TEST_CASE("one and two threads fit the same bits", "[slow]") {
  const Positions positions = GENERATE(Positions::Fitted, Positions::Closest);
  const Parameterization map = bumpy(shapes::grid(2, 3), 4);
  const auto [one, two] = by_one_and_two_threads([&] { return remeshed(map, 5, positions); });
  CHECK(one.positions == two.positions);
}
