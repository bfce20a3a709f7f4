#include "remesh/crease_corners.h"

namespace gsp {

std::vector<int> crease_corners(const SubdivisionLevel& finest, int base_vertices, const std::vector<Vec3>& positions) {
  // Cosine of 34.5°, between the turns of regular polygons of 10 and 11 corners: at a turn that shapes have, such as
  // 30°, rounding would decide.
  constexpr double kStraight = 0.8241261886220157;
  const std::vector<VertexFan> fans = vertex_fans(finest);
  std::vector<int> corners;
  for (int v = 0; v < base_vertices; ++v) {
    if (fans[v].crease_count != 2 || fans[v].sharp_count != 2) continue;
    const auto [first, second] = fans[v].sharp_edges;
    const Vec3 in = positions[v] - positions[finest.other_end(first, v)];
    const Vec3 out = positions[finest.other_end(second, v)] - positions[v];
    if (in.dot(out) < kStraight * in.norm() * out.norm()) corners.push_back(v);
  }
  return corners;
}

}  // namespace gsp
