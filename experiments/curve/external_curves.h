#pragma once

#include <string>
#include <vector>

#include "experiments/curve/meter.h"
#include "experiments/external/external_tool.h"

namespace gsp {

/// A codec's curve: one row for each of its values, whose coder is "NAME VALUE"; or the rows of its file that speak of
/// the meter's surface, whose coder is their label and note. Files are made inside `folder` meanwhile. Throws what
/// `run_codec` and `surface_distance` throw; for points BadOption where the file has none of the surface, and what
/// `read_points_file` throws.
std::vector<CurvePoint> external_curve(const ExternalTool& tool, const Meter& meter, std::size_t samples,
                                       const std::string& folder, Progress& progress);

}  // namespace gsp
