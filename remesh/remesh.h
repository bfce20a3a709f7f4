#pragma once

#include "mesh/export.h"
#include "mesh/progress.h"
#include "param/map/parameterization.h"
#include "remesh/remesh_options.h"
#include "remesh/semiregular.h"

namespace GSP_PUBLIC gsp {

/// Quadrisects the base and maps every dyadic point through the parameterization to the surface (paper §4); fitted
/// positions are then moved to where the faces between them, instead of the points, are nearest to the surface.
/// Sampled points on base vertices are the surface's own vertices, bit for bit. For a map that `check_map` finds valid
/// every sample is the exact inverse. Where a baseline's map folds, faces of positive area are preferred to flipped
/// ones; a point in no face takes the nearest place in a face beside it, and `progress` notes how many there were.
/// Of kind normal, vertices above the base lie on normals where they can (normal/normal_remesh.h); `progress` notes how
/// many do; fitted, base positions and those numbers are nearest to the surface (scalar/scalar_fit.h); of kind
/// displaced all lie on those of a control mesh's surface (displaced/displaced_remesh.h). O(faces + samples), of which
/// a fit takes 16 a vertex or more, on all threads but for the fit's solutions, the same bits for any number of them.
/// Throws Error: BadOption, for kinds that are not built too, InvalidMap where nothing covers a base face, the errors
/// of `require_well_formed`.
SemiregularMesh remesh(const Parameterization& map, const RemeshOptions& options, Progress& progress);

}  // namespace gsp
