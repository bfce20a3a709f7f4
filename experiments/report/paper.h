#pragma once

#include <optional>
#include <string>

namespace gsp {

/// Remeshing error of the paper's Table 1, relative to the bounding box diagonal, for a model whose name holds that of
/// one of its meshes ("horse_48485"); empty for others.
std::optional<double> paper_remesh_error(const std::string& model);

}  // namespace gsp
