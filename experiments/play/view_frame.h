#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include "param/map/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp {

/// The finest level of a mesh with at most so many faces, at least 0.
int level_within(const SemiregularMesh& mesh, long long most_faces);

/// What the pages' 3D view needs of any surface: "level", the finest that is shown; the "camera" that looks at `seen`;
/// "outward", -1 where the faces of `seen` are inside out; the box "low" to "high"; "patch_colours" of the base faces.
/// O(faces of `seen`). Throws what `make_camera` throws.
nlohmann::ordered_json view_frame(const Mesh& seen, const BaseComplex& base, const Eigen::AlignedBox3d& box, int level);

}  // namespace gsp
