#include "coder/precision.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coder/bitplane_coder.h"

namespace gsp {

namespace {

constexpr int kLeastBits = 16, kMostBits = 24;

/// Scanned surfaces are at least 0.11 of the height of an edge's middle over its parent edge away from their remesh in
/// RMS (twelve surfaces: 0.11 to 0.22; a sphere: 0.064), and the decoded mesh is about half a step away from it. The
/// errors add in squares: at this many steps to the height the latter is 20.4 dB under the former and costs 0.04 dB.
constexpr double kStepsPerHeight = 48.0;

/// kPassesPerPlane·log2(x) rounded down, by comparisons only.
int passes_of(double x) {
  static_assert(kPassesPerPlane == 4);
  const int exponent = std::ilogb(x);
  const double mantissa = std::ldexp(x, -exponent);
  int passes = kPassesPerPlane * exponent;
  for (double quarter : {1.189207115002721, 1.4142135623730951, 1.681792830507429}) passes += mantissa >= quarter;
  return passes;
}

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
  constexpr int kLeast = kPassesPerPlane * kLeastBits, kMost = kPassesPerPlane * kMostBits;
  if (!(diagonal > 0.0)) return kLeast;
  if (!(step > 0.0)) return kMost;
  return std::clamp(kPassesPerPlane * std::ilogb(diagonal) - passes_of(step), kLeast, kMost);
}

}  // namespace gsp
