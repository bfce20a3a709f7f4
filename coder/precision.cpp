#include "coder/precision.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gsp {

namespace {

constexpr int kLeastBits = 16, kMostBits = 24;

/// A sphere's best piecewise linear approximation over equilateral triangles is 0.064 of the height of an edge's middle
/// over its parent edge away from it in RMS (remeshes of scanned surfaces: 0.15 to 0.24), the decoded mesh half a step
/// from the remesh (0.42 to 0.60, bench/README.md). At this many steps to the height the latter is 18 dB under the
/// former, and adds 0.06 dB to it.
constexpr double kStepsPerHeight = 64.0;

/// RMS over the area of the heights, along the normals, of edges' middles over their edges.
double rms_height(const SubdivisionLevel& coarse, const std::vector<Vec3>& positions) {
  std::vector<Vec3> normals(coarse.edge_count(), Vec3::Zero());
  for (int f = 0; f < coarse.face_count(); ++f) {
    const auto& [a, b, c] = coarse.faces[f];
    const Vec3 area = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    for (int e : coarse.face_edges[f]) normals[e] += area;
  }
  double sum = 0.0, total = 0.0;
  for (int e = 0; e < coarse.edge_count(); ++e) {
    const double weight = normals[e].norm();
    if (!(weight > 0.0)) continue;
    const auto& [a, b] = coarse.edges[e];
    const Vec3 rise = positions[coarse.vertex_count + e] - (positions[a] + positions[b]) / 2;
    const double height = rise.dot(normals[e] / weight);
    sum += weight * height * height;
    total += weight;
  }
  return total > 0.0 ? std::sqrt(sum / total) : 0.0;
}

}  // namespace

int sufficient_precision(const SubdivisionLevel& coarse, const std::vector<Vec3>& positions, double diagonal) {
  const double step = rms_height(coarse, positions) / kStepsPerHeight;
  if (!(diagonal > 0.0)) return kLeastBits;
  if (!(step > 0.0)) return kMostBits;
  return std::clamp(std::ilogb(diagonal) - std::ilogb(step), kLeastBits, kMostBits);
}

}  // namespace gsp
