#pragma once

#include <vector>

#include "mesh/export.h"
#include "metrics/statistics.h"
#include "param/map/parameterization.h"

namespace GSP_PUBLIC gsp {

/// Distortion of a map by the singular values s1 >= s2 of its faces' maps from chart to surface. Where lengths or areas
/// matter they are in units in which total area on the surface is total area in the charts: then 1 is neutral for s1,
/// s2. Statistics are weighted by area on the surface.
struct Distortion {
  Statistics anisotropy;              ///< Γ_a = s1 / s2 (the paper, §2); neutral 1
  Statistics anisotropy_eigenvalues;  ///< the same by eigenvalues of the metric tensor: Γ_a²; neutral 1
  Statistics area;                    ///< Γ_d = s1·s2; neutral 1, whose mean over the charts it is
  Statistics area_eigenvalues;        ///< det g: Γ_d²; neutral 1
  Statistics stretch_l2;              ///< sqrt((s1² + s2²) / 2) of each face (Sander et al. 2001); neutral 1
  Statistics stretch_linf;            ///< s1 (Sander et al. 2001); neutral 1
  Statistics sorkine;                 ///< max(s1, 1/s2) (Sorkine et al. 2002); neutral 1, which is also its least
  Statistics conformal;       ///< s1/s2 + s2/s1 (Hormann, Greiner 2000: MIPS); neutral 2, which is also its least
  Statistics area_symmetric;  ///< s1·s2 + 1/(s1·s2) (Degener et al. 2003); neutral 2, which is also its least
  double l2_stretch = 0.0;    ///< of the whole map: RMS over area of `stretch_l2`; at least 1
  double linf_stretch = 0.0;  ///< of the whole map: the largest s1
  int flipped_faces = 0;
  int degenerate_faces = 0;  ///< no area on the surface: left out of the statistics
};

/// Flipped faces count into `flipped_faces` and enter the statistics by their absolute area; faces without area in
/// their chart count as flipped and have no values. Throws the errors of `require_well_formed`. O(F log F).
Distortion distortion(const Parameterization& map);

/// #F values per face (singular values), for pictures; 0 for faces without area on the surface or in the chart.
struct FaceDistortion {
  std::vector<double> anisotropy;
  std::vector<double> area;
  std::vector<double> stretch_l2;
  std::vector<double> sorkine;
};
FaceDistortion face_distortion(const Parameterization& map);

}  // namespace gsp
