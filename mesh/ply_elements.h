#pragma once

#include "mesh/mesh.h"
#include "mesh/ply.h"

namespace gsp {

/// The elements of a surface's PLY file, to which further properties may be added: vertices with their position in
/// double, and faces with the list of their corners.
PlyElement ply_vertices(const Mesh& mesh);
PlyElement ply_faces(const Mesh& mesh);

}  // namespace gsp
