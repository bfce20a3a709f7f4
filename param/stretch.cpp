#include "param/stretch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gsp {

namespace {

/// Square of the face's stretch (trace of the metric of the affine map from chart to surface over 2; Sander et al. 2001,
/// equation 1), 1 for the mean scale of the whole map.
double squared_stretch(const Mesh& mesh, int face, const std::array<Complex, 3>& z, double area, double fair) {
  constexpr double kLeastShare = 1e-3;
  const Triangle& t = mesh.faces[face];
  const double image = std::max(chart_area(z[0], z[1], z[2]), kLeastShare * fair * area);
  const Vec3 d1 = (mesh.positions[t[1]] - mesh.positions[t[0]]) / (2.0 * image);
  const Vec3 d2 = (mesh.positions[t[2]] - mesh.positions[t[0]]) / (2.0 * image);
  const Complex e1 = z[1] - z[0], e2 = z[2] - z[0];
  const Vec3 by_u = d1 * e2.imag() - d2 * e1.imag(), by_v = d2 * e1.real() - d1 * e2.real();
  return 0.5 * fair * (by_u.squaredNorm() + by_v.squaredNorm());
}

/// Calls visit(face, area, squared stretch) for all faces with area; chart area per surface area comes from the whole.
template <class Visit>
double for_each_stretch(const Atlas& atlas, Visit&& visit) {
  const Mesh& mesh = atlas.surface->mesh;
  const double total = surface_area(mesh), fair = atlas.base.face_count() * kChartArea / total;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const double area = face_area(mesh, f);
    if (area > 0.0) visit(f, area, squared_stretch(mesh, f, atlas.face_corners(f, atlas.face_frame(f)), area, fair));
  }
  return total;
}

}  // namespace

double l2_stretch(const Atlas& atlas) {
  double sum = 0.0;
  const double total = for_each_stretch(atlas, [&](int, double area, double squared) { sum += area * squared; });
  return std::sqrt(sum / total);
}

std::vector<double> vertex_stretch(const Atlas& atlas) {
  std::vector<double> sum(atlas.patch.size(), 0.0), areas(atlas.patch.size(), 0.0);
  for_each_stretch(atlas, [&](int f, double area, double squared) {
    for (int v : atlas.surface->mesh.faces[f]) {
      sum[v] += area * squared;
      areas[v] += area;
    }
  });
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = areas[v] > 0.0 ? std::sqrt(sum[v] / areas[v]) : 1.0;
  return sum;
}

}  // namespace gsp
