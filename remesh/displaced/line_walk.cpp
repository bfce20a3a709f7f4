#include "remesh/displaced/line_walk.h"

#include <algorithm>
#include <cmath>

#include "mesh/fixed_order.h"

namespace gsp {

std::optional<double> walk_to_line(const SubdivisionLevel& level, const std::vector<Vec3>& positions, int face,
                                   const Vec3& origin, const Vec3& direction) {
  // Far more than between a vertex and where its neighbour lies.
  constexpr int kMostFaces = 300;
  // Of a face's area, by which a line may miss it: no line slips between two faces for rounding.
  constexpr double kRounding = 1e-12;
  for (int step = 0; step < kMostFaces && face >= 0; ++step) {
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = positions[level.faces[face][k]] - origin;
    // Twice the areas, seen along the line, of the triangles between it and each side.
    std::array<double, 3> area;
    for (int k = 0; k < 3; ++k) area[k] = dot(direction, cross(p[k], p[(k + 1) % 3]));
    const double whole = area[0] + area[1] + area[2];
    if (!(whole > 0.0)) return std::nullopt;
    const auto least = std::min_element(area.begin(), area.end()) - area.begin();
    if (area[least] >= -kRounding * whole) {
      const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
      return dot(normal, p[0]) / dot(normal, direction);
    }
    face = level.other_face(level.face_edges[face][least], face);
  }
  return std::nullopt;
}

BoundaryWalk::BoundaryWalk(const SubdivisionLevel& level) : beside_(level.vertex_count, {-1, -1}) {
  const std::vector<VertexFan> fans = vertex_fans(level);
  for (int e = 0; e < level.edge_count(); ++e) {
    if (level.edge_faces[e][1] >= 0) continue;
    const auto [a, b] = level.edges[e];
    if (fans[a].sharp_count == 2) beside_[a][1] = b;
    if (fans[b].sharp_count == 2) beside_[b][0] = a;
  }
}

std::optional<Vec3> BoundaryWalk::to_plane(const std::vector<Vec3>& positions, int vertex, const Vec3& origin,
                                           const Vec3& direction) const {
  constexpr int kMostEdges = 100;
  const auto height = [&](int v) { return dot(direction, positions[v] - origin); };
  double here = height(vertex);
  if (here == 0.0) return positions[vertex];
  for (int way : {0, 1}) {
    const int first = beside_[vertex][way];
    if (first < 0 || std::abs(height(first)) >= std::abs(here)) continue;
    int at = vertex;
    for (int step = 0; step < kMostEdges; ++step) {
      const int next = beside_[at][way];
      if (next < 0) return std::nullopt;
      const double there = height(next);
      if ((there <= 0.0) != (here <= 0.0))
        return positions[at] + here / (here - there) * (positions[next] - positions[at]);
      if (std::abs(there) >= std::abs(here)) return std::nullopt;
      at = next;
      here = there;
    }
  }
  return std::nullopt;
}

}  // namespace gsp
