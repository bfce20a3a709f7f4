#include "metrics/singular_values.h"

#include <cmath>

namespace gsp {

/// Singular values from the metric tensor of the affine map (Sander et al. 2001), written without its cancellation: the
/// sum and difference of squares of (s1 + s2) and (s1 - s2) come from the Jacobian in the face's own frame.
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
  const double xx = (length * v.imag() - bx * u.imag()) / twice_chart,
               xy = (bx * u.real() - length * v.real()) / twice_chart;
  const double yx = -by * u.imag() / twice_chart, yy = by * u.real() / twice_chart;
  const double sum = std::hypot(xx + yy, yx - xy), difference = std::hypot(xx - yy, yx + xy);
  result.largest = 0.5 * (sum + difference);
  result.smallest = result.surface_area / std::abs(result.chart_area) / result.largest;
  return result;
}

std::vector<FaceMap> face_maps(const Parameterization& map) {
  std::vector<FaceMap> faces(map.surface.faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = face_map(map, static_cast<int>(f));
  return faces;
}

double area_scale(const std::vector<FaceMap>& faces) {
  double surface = 0.0, chart = 0.0;
  for (const FaceMap& face : faces) {
    surface += face.surface_area;
    chart += std::abs(face.chart_area);
  }
  return chart > 0.0 && surface > 0.0 ? surface / chart : 1.0;
}

}  // namespace gsp
