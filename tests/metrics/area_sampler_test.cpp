#include "metrics/area_sampler.h"

#include <catch2/catch.hpp>

#include <numeric>

#include <Eigen/Geometry>

#include "mesh/error.h"
#include "mesh/shapes.h"

using namespace gsp;

namespace {
std::vector<int> in_order(const Mesh& mesh) {
  std::vector<int> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<double> areas(const Mesh& mesh) {
  std::vector<double> areas;
  for (int f = 0; f < mesh.face_count(); ++f) areas.push_back(face_area(mesh, f));
  return areas;
}

std::vector<Vec3> samples(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
  const std::vector<int> order = in_order(mesh);
  const AreaSampler sampler(mesh, order, areas(mesh), {}, count, seed);
  std::vector<double> weights(count);
  std::vector<Vec3> points(count);
  for (std::size_t begin = 0; begin < count; begin += AreaSampler::kBlock)
    sampler.sample(begin, std::min(count, begin + AreaSampler::kBlock), points.data() + begin, weights.data() + begin);
  return points;
}
}  // namespace

TEST_CASE("samples fill a square evenly: moments and every cell of a grid") {
  Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.faces = {{0, 1, 2}, {0, 2, 3}};
  const std::size_t count = 1 << 16;
  Vec3 sum = Vec3::Zero();
  double xx = 0, xy = 0;
  std::vector<int> cells(256, 0);
  for (const Vec3& p : samples(square, count, 1)) {
    sum += p;
    xx += p.x() * p.x();
    xy += p.x() * p.y();
    REQUIRE((p.x() >= 0 && p.x() <= 1 && p.y() >= 0 && p.y() <= 1 && p.z() == 0));
    ++cells[static_cast<int>(p.x() * 16) * 16 + static_cast<int>(p.y() * 16)];
  }
  CHECK(sum.x() / count == Approx(0.5).epsilon(1e-4));
  CHECK(sum.y() / count == Approx(0.5).epsilon(1e-4));
  CHECK(xx / count == Approx(1.0 / 3.0).epsilon(1e-4));
  CHECK(xy / count == Approx(0.25).epsilon(1e-4));
  // Strata lie in single cells of this grid but for cells cut by the diagonal: counts are the stratified ones.
  for (int cell : cells) CHECK(std::abs(cell - 256) <= 24);
}

TEST_CASE("each face receives its share of the samples, to one") {
  const Mesh mesh = shapes::torus(17, 9);
  const std::vector<int> order = in_order(mesh);
  const double total = surface_area(mesh);
  const std::size_t count = 20000;
  const std::vector<Vec3> points = samples(mesh, count, 5);
  // Samples come in face order, so the share of a prefix of faces is a prefix of samples.
  std::size_t at = 0;
  double area = 0.0;
  for (int f = 0; f + 1 < mesh.face_count(); ++f) {
    area += face_area(mesh, f);
    const auto expected = static_cast<std::size_t>(area / total * count);
    while (at < expected) {
      const Triangle& t = mesh.faces[f];
      const Vec3 normal =
          (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
      if (std::abs(normal.normalized().dot(points[at] - mesh.positions[t[0]])) > 1e-12) break;
      ++at;
    }
    CHECK(at + 1 >= expected);
    at = std::max(at, expected) + (area / total * count > expected ? 1 : 0);
  }
}

TEST_CASE("faces without area get no samples, wherever they are in the order") {
  Mesh mesh = shapes::grid(3, 3);
  for (int i = 0; i < 40; ++i) mesh.faces.insert(mesh.faces.begin() + (i % 3 ? 5 : 0), {0, 1, 1});
  for (int i = 0; i < 40; ++i) mesh.faces.push_back({2, 2, 2});
  for (std::size_t count : {1, 7, 5000}) {
    for (const Vec3& p : samples(mesh, count, 2)) CHECK((p.x() >= 0 && p.x() <= 3 && p.y() >= 0 && p.y() <= 3));
  }
  Mesh flat = shapes::grid(1, 1);
  flat.faces = {{0, 0, 1}};
  CHECK_THROWS_AS(samples(flat, 10, 1), Error);
}

TEST_CASE("neighbours in the sequence are neighbours on the surface") {
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.faces = {{0, 1, 2}};
  const std::size_t count = 1 << 15;
  const std::vector<Vec3> points = samples(triangle, count, 9);
  double longest = 0.0;
  for (std::size_t i = 1; i < count; ++i) longest = std::max(longest, (points[i] - points[i - 1]).norm());
  CHECK(longest < 5.0 / std::sqrt(count));
}
