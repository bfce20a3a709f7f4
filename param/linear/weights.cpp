#include "param/linear/weights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include <Eigen/Geometry>

#include "mesh/parallel.h"
#include "param/linear/intrinsic_triangulation.h"

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

std::vector<std::array<double, 2>> mean_value_weights(const Surface& surface) {
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

}  // namespace

LinearWeights::LinearWeights(const Surface& surface, Weights kind) : surface_(surface), kind_(kind) {
  if (kind == Weights::MeanValue) edges_ = mean_value_weights(surface);
  if (kind == Weights::Uniform) edges_.assign(surface.edge_count(), {1.0, 1.0});
}

std::vector<Spring> LinearWeights::springs(const Atlas& atlas, const std::vector<int>& faces) const {
  assert(std::adjacent_find(faces.begin(), faces.end(), std::greater_equal<>()) == faces.end());
  if (kind_ == Weights::Cotangent) return delaunay_springs(atlas, faces);
  std::vector<Spring> springs;
  springs.reserve(2 * faces.size());
  for (int f : faces)
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int e = surface_.edge_of[h], twin = surface_.halfedges.twin[h];
      const bool forward = surface_.edge_halfedge[e] == h;
      // An edge between two of the faces once.
      if (!forward && std::binary_search(faces.begin(), faces.end(), twin / 3)) continue;
      springs.push_back({surface_.halfedges.from(h), surface_.halfedges.to(h), atlas.towards(e, forward),
                         edges_[e][forward ? 0 : 1], edges_[e][forward ? 1 : 0]});
    }
  return springs;
}

std::vector<Spring> LinearWeights::delaunay_springs(const Atlas& atlas, const std::vector<int>& faces) const {
  IntrinsicTriangulation triangulation(surface_, faces);
  auto& halfedges = triangulation.halfedges();
  for (std::size_t i = 0; i < halfedges.size(); ++i) {
    const int h = 3 * faces[i / 3] + static_cast<int>(i % 3), e = surface_.edge_of[h];
    halfedges[i].towards = atlas.towards(e, surface_.edge_halfedge[e] == h);
  }
  triangulation.make_delaunay(atlas.corner);
  std::vector<Spring> springs;
  springs.reserve(halfedges.size() / 2);
  for (int h = 0; h < static_cast<int>(halfedges.size()); ++h) {
    const auto& [from, twin, length, towards] = halfedges[h];
    if (twin >= 0 && twin < h) continue;
    // Negative only between two corners, which are held, and on the border.
    const double weight =
        std::max(triangulation.half_cotangent(h) + (twin >= 0 ? triangulation.half_cotangent(twin) : 0.0), 0.0);
    springs.push_back({from, halfedges[Halfedges::next(h)].from, towards, weight, weight});
  }
  return springs;
}

}  // namespace gsp
