#pragma once

#include <vector>

#include "param/parameterization.h"

namespace gsp {

/// Area-weighted statistics of a per-face quantity (weights: area on the surface).
struct Statistics {
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double maximum = 0.0;
};

/// Distortion of a map by the paper's measures (§2) from the singular values s1 >= s2 of the map from chart to surface.
struct Distortion {
  Statistics anisotropy;             ///< Γ_a = s1 / s2; 1 is isotropic
  Statistics anisotropy_eigenvalues; ///< the same by eigenvalues of the metric tensor: Γ_a²
  Statistics area;                   ///< Γ_d = s1·s2, normalised by total surface area over total chart area; 1 is neutral
  Statistics area_eigenvalues;       ///< det g normalised the same way: Γ_d²
  int flipped_faces = 0;
  int degenerate_faces = 0;          ///< no area on the surface: left out of the statistics
};

/// Flipped faces count into `flipped_faces` and enter the statistics by their absolute area; faces without area in their
/// chart count as flipped and have no values. O(F log F).
Distortion distortion(const Parameterization& map);

/// #F Γ_a and Γ_d per face (singular values), for pictures; 0 for faces without area on the surface or in the chart.
struct FaceDistortion {
  std::vector<double> anisotropy;
  std::vector<double> area;
};
FaceDistortion face_distortion(const Parameterization& map);

}  // namespace gsp
