#pragma once

#include <string>

#include "experiments/report/run.h"
#include "mesh/progress.h"

namespace gsp {

/// What the page's 3D view needs of one cell, as JSON: for up to eight sizes of the stream the distances of the decoded
/// positions to the input; measures of the map, taken on the remesh, as one byte a vertex; and either the streams,
/// which the page decodes itself (experiments/play), or the connectivity as one triangular grid of vertex indices for
/// each patch and the positions of the sizes, 16 bits a coordinate. Finer levels than about 70,000 faces are left out,
/// which a screen would not show. The cell is done and has a stream, its model a surface. Throws what reading and
/// decoding throw. About a second a size.
std::string view_json(const StoredModel& model, const StoredCell& cell, bool with_streams, Progress& progress);

}  // namespace gsp
