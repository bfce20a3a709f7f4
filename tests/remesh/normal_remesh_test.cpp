#include "remesh/normal/normal_remesh.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <limits>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/local_frames.h"
#include "remesh/filters/normal_share.h"
#include "remesh/normal/piercing.h"
#include "tests/by_threads.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// A normal remesh, and the levels it hangs on.
struct Normal {
  Progress progress;
  std::vector<SubdivisionLevel> levels;
  NormalRemesh mesh;

  Normal(const Parameterization& map, int level, double aperture = NormalOptions().aperture)
      : levels(subdivision_levels(map.base.vertex_count(), map.base.faces, level)),
        mesh(normal_remesh(map, pieces_by_chart(map), levels, {aperture}, progress)) {}

  int count(VertexForm form) const { return static_cast<int>(std::count(mesh.forms.begin(), mesh.forms.end(), form)); }
  /// Of all vertices above the base, in the frames that a decoder of the levels has.
  std::vector<Vec3> details() const {
    std::vector<Vec3> details;
    for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
      const std::vector<Vec3> coarse(mesh.positions.begin(), mesh.positions.begin() + levels[l].vertex_count);
      std::vector<Vec3> predicted(levels[l + 1].vertex_count, Vec3::Zero());
      butterfly_low_pass(levels[l])->add(coarse.data(), predicted.data());
      const EdgeFrames frames(levels[l], coarse);
      for (int e = 0; e < levels[l].edge_count(); ++e) {
        const int v = levels[l].vertex_count + e;
        details.push_back(frames(e).transpose() * (mesh.positions[v] - predicted[v]));
      }
    }
    return details;
  }
};

/// The base quadrisected, each vertex put where `place` says, under a valid map that crosses base edges.
template <class Place>
Parameterization mapped(const Mesh& base, int level, Place place, double jitter = 0.19) {
  Parameterization map = exact_maps::quadrisected(base, level);
  for (Vec3& p : map.surface.positions) p = place(p);
  exact_maps::jitter(map, jitter, level, 5);
  return map;
}

Vec3 on_sphere(const Vec3& p) { return p.normalized(); }
Vec3 on_torus(const Vec3& p) {
  const Vec3 ring = Vec3(p.x(), p.y(), 0.0).normalized();
  return ring + 0.4 * (p - ring).normalized();
}

/// Where on a surface a point lies, by search: chart and place there, and the distance.
struct Found {
  int chart = -1;
  Complex z;
  double distance = std::numeric_limits<double>::infinity();
};

Found by_search(const Parameterization& map, const Vec3& p) {
  Found best;
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const Triangle& t = map.surface.faces[f];
    const Vec3 &a = map.surface.positions[t[0]], &b = map.surface.positions[t[1]], &c = map.surface.positions[t[2]];
    const Vec3 n = (b - a).cross(c - a);
    std::array<double, 3> w = {(b - p).cross(c - p).dot(n), (c - p).cross(a - p).dot(n), (a - p).cross(b - p).dot(n)};
    double sum = 0.0;
    for (double& x : w) sum += x = std::max(x, 0.0);
    Vec3 there = (w[0] * a + w[1] * b + w[2] * c) / sum;
    const double distance = (there - p).norm();
    if (distance >= best.distance) continue;
    best = {map.face_chart[f], 0.0, distance};
    for (int k = 0; k < 3; ++k) best.z += w[k] / sum * map.face_corners[f][k];
  }
  return best;
}

/// The places that a place of a chart has in the chart of base face `in`, by ways over up to `steps` base edges.
void images(const BaseComplex& base, int chart, Complex z, int in, int steps, std::vector<Complex>& found) {
  if (chart == in) found.push_back(z);
  if (steps == 0) return;
  for (int h = 3 * chart; h < 3 * chart + 3; ++h)
    if (base.twins[h] >= 0) images(base, base.twins[h] / 3, base.across(h).apply(z), in, steps - 1, found);
}

/// The middles of edges, taken again and again: where corner k of finest face `face` lies without any normals.
Complex dyadic(int face, int level, int k) {
  std::array<Complex, 3> z = {kChartCorners[0].value(), kChartCorners[1].value(), kChartCorners[2].value()};
  for (int l = level - 1; l >= 0; --l) {
    const std::array<Complex, 3> middle = {0.5 * (z[0] + z[1]), 0.5 * (z[1] + z[2]), 0.5 * (z[2] + z[0])};
    const int child = face >> (2 * l) & 3;
    if (child == 3) z = middle;
    if (child == 0) z = {z[0], middle[0], middle[2]};
    if (child == 1) z = {middle[0], z[1], middle[1]};
    if (child == 2) z = {middle[2], middle[1], z[2]};
  }
  return z[k];
}

/// Looks up every vertex on the surface by its position alone, and checks that the faces cover the domain once: all
/// upright, and together as large as it.
void check_upright(const Parameterization& map, const Normal& remesh) {
  const SubdivisionLevel& finest = remesh.levels.back();
  const int level = static_cast<int>(remesh.levels.size()) - 1;
  std::vector<Found> places;
  for (const Vec3& p : remesh.mesh.positions) {
    places.push_back(by_search(map, p));
    CHECK(places.back().distance < 1e-12);
  }
  double sum = 0.0, least = 1.0;
  for (int f = 0; f < finest.face_count(); ++f) {
    const int chart = f >> (2 * level);
    std::array<Complex, 3> z;
    for (int k = 0; k < 3; ++k) {
      const Found& place = places[finest.faces[f][k]];
      std::vector<Complex> seen;
      images(map.base, place.chart, place.z, chart, 4, seen);
      REQUIRE(!seen.empty());
      const Complex near = dyadic(f, level, k);
      z[k] = *std::min_element(seen.begin(), seen.end(),
                               [&](Complex a, Complex b) { return std::abs(a - near) < std::abs(b - near); });
    }
    const double area = chart_area(z[0], z[1], z[2]);
    least = std::min(least, area);
    sum += area;
  }
  CHECK(least > 0.0);
  CHECK(sum == Approx(map.base.face_count() * kChartArea).epsilon(1e-9));
}

void check_all_normal(const Parameterization& map, int level) {
  const Normal remesh(map, level, 1.0);
  CHECK(remesh.count(VertexForm::Normal) == static_cast<int>(remesh.mesh.forms.size()));
  for (const Vec3& detail : remesh.details()) CHECK(detail.tail<2>().norm() < 1e-14);
  check_upright(map, remesh);
}

}  // namespace

TEST_CASE("a line meets one of two triangles at an edge, from behind only") {
  const std::array<Vec3, 3> left = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const std::array<Vec3, 3> right = {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  CHECK(pierce({{0.25, 0.25, -3.0}, Vec3::UnitZ()}, left).value() == std::array<double, 3>{0.5, 0.25, 0.25});
  CHECK_FALSE(pierce({{0.25, 0.25, -3.0}, -Vec3::UnitZ()}, left));
  CHECK_FALSE(pierce({{0.75, 0.5, 0.0}, Vec3::UnitZ()}, left));
  CHECK_FALSE(pierce({{0.25, 0.25, 1.0}, Vec3::UnitX()}, left));
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double s = random.uniform();
    const Vec3 direction = Vec3(random.uniform() - 0.5, random.uniform() - 0.5, 0.1 + random.uniform()).normalized();
    const Line line = {Vec3(s, 1.0 - s, 0.0) - 7.0 * direction, direction};
    CHECK((pierce(line, left) || pierce(line, right)));
  }
}

TEST_CASE("a plane's normal remesh has no details") {
  const Parameterization map = mapped(shapes::grid(3, 3), 2, [](const Vec3& p) { return p; });
  const Normal remesh(map, 4, 1.0);
  CHECK(remesh.count(VertexForm::Parametric) == 0);
  CHECK(remesh.count(VertexForm::Boundary) == 4 * 3 * 15);
  const std::vector<Vec3> details = remesh.details();
  for (std::size_t v = 0; v < details.size(); ++v)
    if (remesh.mesh.forms[v] == VertexForm::Normal) CHECK(details[v].norm() < 1e-14);
  check_upright(map, remesh);
}

TEST_CASE("all vertices of a normal remesh of a sphere are normal, on the surface, and upright", "[slow]") {
  check_all_normal(mapped(shapes::icosahedron(), 3, on_sphere), 3);
}

TEST_CASE("all vertices of a normal remesh of a torus are normal, on the surface, and upright", "[slow]") {
  check_all_normal(mapped(shapes::lattice_torus(24, 12), 2, on_torus, 0.1), 2);
}

TEST_CASE("between sheets and on rough ground no face of a normal remesh folds, and exceptions are points of the map",
          "[slow]") {
  const auto lens = [](const Vec3& p) { return Vec3(on_sphere(p).cwiseProduct(Vec3(1.0, 1.0, 0.02))); };
  const auto cup = [](const Vec3& p) {
    Vec3 q = on_sphere(p).cwiseProduct(Vec3(1.0, 1.0, 0.05));
    q.z() += 1.5 * (q.x() * q.x() + q.y() * q.y());
    return q;
  };
  Random random(3);
  const auto rough = [&](const Vec3& p) { return Vec3(on_sphere(p) * (1.0 + 0.3 * random.uniform())); };
  const auto hilly = [&](const Vec3& p) { return Vec3(p + 0.2 * random.uniform() * Vec3::UnitZ()); };
  std::vector<Parameterization> maps = {mapped(shapes::octahedron(), 3, lens), mapped(shapes::octahedron(), 3, cup),
                                        mapped(shapes::tetrahedron(), 3, rough),
                                        mapped(shapes::icosahedron(), 2, rough),
                                        mapped(shapes::sector_disc(5, 0), 3, hilly)};
  int exceptions = 0;
  for (const Parameterization& map : maps) {
    const Normal remesh(map, 4);
    exceptions += remesh.count(VertexForm::Parametric);
    const std::vector<Vec3> details = remesh.details();
    for (std::size_t v = 0; v < details.size(); ++v)
      if (remesh.mesh.forms[v] == VertexForm::Normal) CHECK(details[v].tail<2>().norm() < 1e-13);
    check_upright(map, remesh);
  }
  CHECK(exceptions > 0);
}

TEST_CASE("a file's normal share is what the remesher took") {
  const Parameterization map = mapped(shapes::tetrahedron(), 3, [](const Vec3& p) {
    return Vec3(on_sphere(p) * (1.0 + 0.2 * std::sin(5.0 * p.x()) * std::cos(7.0 * p.y())));
  });
  const Normal remesh(map, 4);
  const NormalShare share = normal_share({4, map.base.vertex_count(), map.base.faces, remesh.mesh.positions});
  CHECK(share.vertices == static_cast<int>(remesh.mesh.forms.size()));
  CHECK(share.normal == remesh.count(VertexForm::Normal));
  CHECK(share.exceptions == remesh.count(VertexForm::Parametric));
  CHECK(share.exceptions > 0);
  CHECK(share.boundary == 0);
  const Parameterization open = mapped(shapes::grid(3, 3), 2, [](const Vec3& p) { return p; });
  CHECK(normal_share({2, 16, open.base.faces, Normal(open, 2).mesh.positions}).boundary == 4 * 3 * 3);
}

TEST_CASE("a normal remesh is the same bits on one thread and on two") {
  const Parameterization map = mapped(shapes::icosahedron(), 3, on_sphere);
  const auto [one, two] = by_one_and_two_threads([&] { return Normal(map, 4); });
  CHECK(one.mesh.positions == two.mesh.positions);
  CHECK(one.mesh.forms == two.mesh.forms);
}
