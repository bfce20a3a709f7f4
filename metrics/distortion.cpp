#include "metrics/distortion.h"

#include <algorithm>
#include <cmath>

namespace gsp {

namespace {

/// One face's map from its chart to the surface.
struct FaceMap {
  double largest = 0.0, smallest = 0.0;  ///< singular values
  double surface_area = 0.0;
  double chart_area = 0.0;               ///< signed
};

/// Singular values from the metric tensor of the affine map (Sander et al. 2001), written without its cancellation: the sum
/// and difference of squares of (s1 + s2) and (s1 - s2) come from the Jacobian in the face's own frame.
FaceMap face_map(const Parameterization& map, int face) {
  const Triangle& t = map.surface.faces[face];
  const auto& c = map.face_corners[face];
  const Vec3 a = map.surface.positions[t[1]] - map.surface.positions[t[0]];
  const Vec3 b = map.surface.positions[t[2]] - map.surface.positions[t[0]];
  const Complex u = c[1] - c[0], v = c[2] - c[0];
  FaceMap result;
  result.surface_area = face_area(map.surface, face);
  result.chart_area = chart_area(c[0], c[1], c[2]);
  const double length = a.norm(), twice_chart = 2.0 * result.chart_area;
  if (!(result.surface_area > 0.0) || twice_chart == 0.0 || length == 0.0) return result;
  // The face in its plane: a along x, b at (bx, by). Then J = [a b] [u v]^-1.
  const double bx = b.dot(a) / length, by = 2.0 * result.surface_area / length;
  const double xx = (length * v.imag() - bx * u.imag()) / twice_chart, xy = (bx * u.real() - length * v.real()) / twice_chart;
  const double yx = -by * u.imag() / twice_chart, yy = by * u.real() / twice_chart;
  const double sum = std::hypot(xx + yy, yx - xy), difference = std::hypot(xx - yy, yx + xy);
  result.largest = 0.5 * (sum + difference);
  result.smallest = result.surface_area / std::abs(result.chart_area) / result.largest;
  return result;
}

struct Weighted {
  double value, weight;
};

/// The value below which `share` of the weight lies; values sorted.
double quantile(const std::vector<Weighted>& sorted, double total, double share) {
  double below = 0.0;
  for (const Weighted& w : sorted) {
    below += w.weight;
    if (below >= share * total) return w.value;
  }
  return sorted.empty() ? 0.0 : sorted.back().value;
}

Statistics statistics(std::vector<Weighted> values) {
  std::stable_sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  Statistics result;
  double total = 0.0, sum = 0.0;
  for (const Weighted& w : values) {
    total += w.weight;
    sum += w.weight * w.value;
  }
  if (!(total > 0.0)) return result;
  result.mean = sum / total;
  result.median = quantile(values, total, 0.5);
  result.p95 = quantile(values, total, 0.95);
  result.maximum = values.back().value;
  return result;
}

/// Every face's map, and what a map without area distortion would multiply areas by.
struct MapSummary {
  std::vector<FaceMap> faces;
  double area_scale = 1.0;
};

MapSummary summarize(const Parameterization& map) {
  MapSummary summary;
  double surface = 0.0, chart = 0.0;
  for (int f = 0; f < map.surface.face_count(); ++f) {
    summary.faces.push_back(face_map(map, f));
    surface += summary.faces.back().surface_area;
    chart += std::abs(summary.faces.back().chart_area);
  }
  if (chart > 0.0 && surface > 0.0) summary.area_scale = surface / chart;
  return summary;
}

}  // namespace

Distortion distortion(const Parameterization& map) {
  const MapSummary summary = summarize(map);
  Distortion result;
  std::vector<Weighted> anisotropy, area;
  for (const FaceMap& face : summary.faces) {
    if (!(face.chart_area > 0.0)) ++result.flipped_faces;
    if (!(face.surface_area > 0.0)) ++result.degenerate_faces;
    if (face.largest == 0.0) continue;
    anisotropy.push_back({face.largest / face.smallest, face.surface_area});
    area.push_back({face.largest * face.smallest / summary.area_scale, face.surface_area});
  }
  const auto squared = [](std::vector<Weighted> values) {
    for (Weighted& w : values) w.value *= w.value;
    return values;
  };
  result.anisotropy = statistics(anisotropy);
  result.anisotropy_eigenvalues = statistics(squared(anisotropy));
  result.area = statistics(area);
  result.area_eigenvalues = statistics(squared(area));
  return result;
}

FaceDistortion face_distortion(const Parameterization& map) {
  const MapSummary summary = summarize(map);
  FaceDistortion result;
  for (const FaceMap& face : summary.faces) {
    const bool counted = face.largest > 0.0;
    result.anisotropy.push_back(counted ? face.largest / face.smallest : 0.0);
    result.area.push_back(counted ? face.largest * face.smallest / summary.area_scale : 0.0);
  }
  return result;
}

}  // namespace gsp
