#include "param/weights.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "mesh/parallel.h"

namespace gsp {

namespace {

constexpr double kLargestTangent = 1e4;  // of a half angle: 179.99 degrees
constexpr double kSmallestTangent = 1e-6;
constexpr double kSmallestLength = 1e-6;  // of the face's perimeter

/// tan(α/2) of the angle between a and b.
double half_angle_tangent(const Vec3& a, const Vec3& b) {
  const double sine = a.cross(b).norm(), cosine = a.dot(b), lengths = a.norm() * b.norm();
  if (!(lengths > 0.0)) return 0.5;
  return std::clamp(sine / (lengths + cosine), kSmallestTangent, kLargestTangent);
}

}  // namespace

EdgeWeights mean_value_weights(const Surface& surface) {
  const auto& p = surface.mesh.positions;
  std::vector<std::array<double, 2>> weights(surface.edge_count());
  parallel_for(weights.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      weights[e] = {0.0, 0.0};
      const int first = surface.edge_halfedge[e];
      for (int h : {first, surface.halfedges.twin[first]}) {
        if (h < 0) continue;
        const Vec3 &tail = p[surface.halfedges.from(h)], &head = p[surface.halfedges.to(h)],
                   &apex = p[surface.halfedges.from(Halfedges::prev(h))];
        const double perimeter = (head - tail).norm() + (apex - head).norm() + (tail - apex).norm();
        double length = std::max((head - tail).norm(), kSmallestLength * perimeter);
        if (!(length > 0.0)) length = 1.0;
        const double at_tail = half_angle_tangent(head - tail, apex - tail) / length;
        const double at_head = half_angle_tangent(tail - head, apex - head) / length;
        weights[e][h == first ? 0 : 1] += at_tail;
        weights[e][h == first ? 1 : 0] += at_head;
      }
    }
  });
  return weights;
}

}  // namespace gsp
