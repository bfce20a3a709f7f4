#include "metrics/distortion.h"

#include <algorithm>
#include <cmath>

#include "metrics/singular_values.h"

namespace gsp {

namespace {

double anisotropy(double s1, double s2) { return s1 / s2; }
double area(double s1, double s2) { return s1 * s2; }
double stretch_l2(double s1, double s2) { return std::sqrt(0.5 * (s1 * s1 + s2 * s2)); }
double stretch_linf(double s1, double) { return s1; }
double sorkine(double s1, double s2) { return std::max(s1, 1.0 / s2); }
double conformal(double s1, double s2) { return s1 / s2 + s2 / s1; }
double area_symmetric(double s1, double s2) { return s1 * s2 + 1.0 / (s1 * s2); }

/// Every face's map, with what brings its singular values to the units of the measures.
struct Faces {
  explicit Faces(const Parameterization& map) : maps(face_maps(map)), unit(1.0 / std::sqrt(area_scale(maps))) {}

  /// A measure's value on every face that has one, weighted by the face's area.
  std::vector<Weighted> weighted(double (*measure)(double, double)) const {
    std::vector<Weighted> values;
    for (const FaceMap& face : maps)
      if (face.counted()) values.push_back({measure(unit * face.largest, unit * face.smallest), face.surface_area});
    return values;
  }

  /// #F, 0 where a face has none.
  std::vector<double> values(double (*measure)(double, double)) const {
    std::vector<double> values;
    for (const FaceMap& face : maps)
      values.push_back(face.counted() ? measure(unit * face.largest, unit * face.smallest) : 0.0);
    return values;
  }

  std::vector<FaceMap> maps;
  double unit;
};

std::vector<Weighted> squared(std::vector<Weighted> values) {
  for (Weighted& w : values) w.value *= w.value;
  return values;
}

}  // namespace

Distortion distortion(const Parameterization& map) {
  require_well_formed(map);
  const Faces faces(map);
  Distortion result;
  for (const FaceMap& face : faces.maps) {
    if (!(face.chart_area > 0.0)) ++result.flipped_faces;
    if (!(face.surface_area > 0.0)) ++result.degenerate_faces;
  }
  result.anisotropy = statistics(faces.weighted(anisotropy));
  result.anisotropy_eigenvalues = statistics(squared(faces.weighted(anisotropy)));
  result.area = statistics(faces.weighted(area));
  result.area_eigenvalues = statistics(squared(faces.weighted(area)));
  result.stretch_l2 = statistics(faces.weighted(stretch_l2));
  result.stretch_linf = statistics(faces.weighted(stretch_linf));
  result.sorkine = statistics(faces.weighted(sorkine));
  result.conformal = statistics(faces.weighted(conformal));
  result.area_symmetric = statistics(faces.weighted(area_symmetric));
  result.l2_stretch = std::sqrt(statistics(squared(faces.weighted(stretch_l2))).mean);
  result.linf_stretch = result.stretch_linf.maximum;
  return result;
}

FaceDistortion face_distortion(const Parameterization& map) {
  require_well_formed(map);
  const Faces faces(map);
  return {faces.values(anisotropy), faces.values(area), faces.values(stretch_l2), faces.values(sorkine)};
}

}  // namespace gsp
