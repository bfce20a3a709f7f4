#include "param/simplify/removal_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mesh/parallel.h"
#include "mesh/random.h"

namespace gsp {

namespace {

constexpr double kPriceNoise = 1e-4;
constexpr int kLargestValence = 12;  // of a vertex that goes (Lee et al. 1998, §3.1)

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

double factor_of_chance(int replicate, int vertex) {
  if (replicate == 0) return 1.0;
  // A generator of its own for each vertex, so that its factor does not depend on the order of the prices.
  Random random(static_cast<std::uint64_t>(replicate) << 32 | static_cast<std::uint32_t>(vertex));
  return 1.0 + kPriceNoise * (2.0 * random.uniform() - 1.0);
}

StarShape star_shape(const Star& star, const std::vector<Vec3>& positions) {
  const Vec3& center = positions[star.center];
  const auto spoke = [&](int k) -> Vec3 { return positions[star.ring[k % star.size()]] - center; };
  const int triangles = static_cast<int>(star.triangles.size());
  std::vector<Vec3> normals;
  StarShape shape;
  for (int k = 0; k < triangles; ++k) {
    normals.push_back(spoke(k).cross(spoke(k + 1)));
    shape.area += 0.5 * normals.back().norm();
  }
  if (!(shape.area > 0.0)) return {};
  double bend = 0.0;
  for (int k = star.boundary ? 1 : 0; k < triangles; ++k)
    bend += spoke(k).norm() * angle_between(normals[(k + triangles - 1) % triangles], normals[k]);
  shape.curvature = 0.5 * bend / (shape.area / 3.0);
  if (star.boundary) {
    const Vec3 first = spoke(0), last = spoke(star.size() - 1);
    const double length = 0.5 * (first.norm() + last.norm());
    if (length > 0.0) shape.curvature += angle_between(first, -last) / length;
  }
  return shape;
}

MapsOrder::MapsOrder(const TriangleComplex& complex, const std::vector<Vec3>& positions, int replicate)
    : complex_(complex),
      positions_(positions),
      replicate_(replicate),
      due_(positions.size(), 0),
      weight_(positions.size(), 0.0) {}

void MapsOrder::begin_round(const std::vector<int>& vertices) {
  ++round_;
  std::vector<StarShape> shapes(vertices.size());
  parallel_for(vertices.size(), 1024, [&](std::size_t begin, std::size_t end) {
    Star star;
    for (std::size_t i = begin; i < end; ++i) {
      complex_.gather(vertices[i], star);
      shapes[i] = star_shape(star, positions_);
      due_[vertices[i]] = star.size() > kLargestValence ? round_ + 1 : round_;
    }
  });
  StarShape most{1e-300, 1e-300};  // so that a surface without curvature divides by no zero
  for (const StarShape& s : shapes) {
    most.area = std::max(most.area, s.area);
    most.curvature = std::max(most.curvature, s.curvature);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double mean = 0.5 * (shapes[i].area / most.area + shapes[i].curvature / most.curvature);
    weight_[vertices[i]] = std::min(0.5 * mean * factor_of_chance(replicate_, vertices[i]), 0.75);
  }
}

}  // namespace gsp
