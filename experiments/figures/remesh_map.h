#pragma once

#include "param/map/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A semi-regular mesh as a map of itself onto its base: every face lies where quadrisection put it in its base face.
/// With it a remesh, also one of another tool, is drawn and measured like a map. Throws the errors of `base_level`.
/// O(faces).
Parameterization remesh_as_map(const SemiregularMesh& mesh);

/// The mesh at another level: vertices of finer ones left out, or midpoints added, which leaves the surface as it is.
/// O(faces). Throws the errors of `subdivision_levels`.
SemiregularMesh at_level(SemiregularMesh mesh, int level);

}  // namespace gsp
