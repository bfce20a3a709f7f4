#pragma once

#include <string>

#include "experiments/report/run.h"
#include "mesh/progress.h"

namespace gsp {

/// What the page's 3D view needs of one cell, as JSON: the connectivity as one triangular grid of vertex indices for
/// each patch, and for up to eight sizes of the stream the decoded positions (16 bits a coordinate) and their distances
/// to the input; measures of the map, taken on the remesh, as one byte a vertex. Finer levels than about 70,000 faces
/// are left out, which a screen would not show. `outward` is -1 where the input's faces are inside out. The cell is
/// done and has a stream, its model a surface. Throws what reading and decoding throw. About a second a size.
std::string view_json(const StoredModel& model, const StoredCell& cell, Progress& progress);

}  // namespace gsp
