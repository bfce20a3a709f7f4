#include "remesh/crease_corners.h"

namespace gsp {

std::vector<int> crease_corners(const SubdivisionLevel& finest, int base_vertices, const std::vector<Vec3>& positions) {
  constexpr double kStraight = 0.8660254037844386;  // cosine
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
