#include "param/atlas/stretch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gsp {

double l2_stretch(const Atlas& atlas) {
  constexpr double kLeastShare = 1e-3;
  const Mesh& mesh = atlas.surface->mesh;
  const double chart_total = atlas.base.face_count() * kChartArea;
  const double surface_total = surface_area(mesh);
  const double fair = chart_total / surface_total;
  double sum = 0.0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.faces[f];
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    const double area = face_area(mesh, f);
    const double image = std::max(chart_area(z[0], z[1], z[2]), kLeastShare * fair * area);
    if (!(area > 0.0)) continue;
    // Trace of the metric of the affine map from chart to surface (Sander et al. 2001, equation 1).
    const Vec3 d1 = (mesh.positions[t[1]] - mesh.positions[t[0]]) / (2.0 * image);
    const Vec3 d2 = (mesh.positions[t[2]] - mesh.positions[t[0]]) / (2.0 * image);
    const Complex e1 = z[1] - z[0], e2 = z[2] - z[0];
    const Vec3 by_u = d1 * e2.imag() - d2 * e1.imag(), by_v = d2 * e1.real() - d1 * e2.real();
    sum += area * 0.5 * (by_u.squaredNorm() + by_v.squaredNorm());
  }
  return std::sqrt(sum / surface_total * fair);
}

}  // namespace gsp
