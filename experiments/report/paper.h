#pragma once

#include <optional>

#include "experiments/store/store.h"
#include "mesh/mesh.h"

namespace gsp {

/// Second moment of a surface's area about its centroid over the square of the area: the same however the surface is
/// moved, turned, scaled and its vertices are numbered. Empty for a surface without area. O(F).
std::optional<double> relative_spread(const Mesh& surface);

/// Remeshing error of the paper's Table 1, relative to the bounding box diagonal, where the surface is one of its
/// models: the same numbers of vertices and faces, and the same shape (`relative_spread`), whatever it is called. Empty
/// for others, and for David and the rabbit, whose shapes nobody here could measure.
std::optional<double> paper_remesh_error(const Mesh& surface);

/// The same for a model of a run, whose surface is read where its counts are those of one of the models. Empty where it
/// has none.
std::optional<double> paper_remesh_error(const StoredModel& model);

}  // namespace gsp
