#pragma once

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "metrics/surface_distance.h"

namespace GSP_PUBLIC gsp {

/// Peak signal-to-noise ratios go by several definitions, which differ by up to some 5 dB: none is printed without its
/// name, peak and formula.
struct Psnr {
  const char* name;
  const char* formula;
  double peak = 0.0;  ///< in the coordinates' unit
  double db = 0.0;    ///< infinite for equal surfaces
};

/// The one every curve of gsp is drawn in: 20 log10(bounding-box diagonal of the reference / larger RMS).
Psnr diagonal_psnr(const SurfaceDistance& distance);

/// MPEG's D1 (point to point), with the longest side of the reference's bounding box as peak: 10 log10(3 peak^2 /
/// larger mean square). The nearest point is that of the other surface, which is what D1 tends to as its clouds get
/// denser.
Psnr mpeg_d1_psnr(const Mesh& reference, const SurfaceDistance& distance);

/// MPEG's D2 (point to plane): as D1, of the part of the error along the normal of the face that is nearest in the
/// other surface. Takes its own `options.samples` even samples a direction. Throws Error(NoFaces, BadOption).
Psnr mpeg_d2_psnr(const Mesh& reference, const SurfaceTree& reference_tree, const Mesh& other,
                  const SurfaceTree& other_tree, const DistanceOptions& options, Progress& progress);

}  // namespace gsp
