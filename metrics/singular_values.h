#pragma once

#include <vector>

#include "param/map/parameterization.h"

namespace gsp {

/// One face's affine map from its chart to the surface.
struct FaceMap {
  double largest = 0.0, smallest = 0.0;  ///< singular values s1 >= s2; 0 where the face has no area here or there
  double surface_area = 0.0;
  double chart_area = 0.0;  ///< signed

  bool counted() const { return largest > 0.0; }
};

/// A face that is flipped in its chart has the singular values of its mirror image.
FaceMap face_map(const Parameterization& map, int face);

/// Total area on the surface over that in the charts, flipped faces by their absolute area: what a map without area
/// distortion multiplies areas by. 1 where there is no area.
double area_scale(const std::vector<FaceMap>& faces);

/// #F
std::vector<FaceMap> face_maps(const Parameterization& map);

}  // namespace gsp
