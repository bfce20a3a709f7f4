#pragma once

#include "param/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A semi-regular mesh as a map of itself onto its base: every face lies where quadrisection put it in its base face.
/// With it a remesh, also one of another tool, is drawn and measured like a map. Throws the errors of `base_level`.
/// O(faces).
Parameterization remesh_as_map(const SemiregularMesh& mesh);

}  // namespace gsp
