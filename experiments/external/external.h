#pragma once

#include <string>
#include <vector>

#include "experiments/cells/external_tool.h"
#include "experiments/curve/meter.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A codec's curve: one point for each of its values, in their order, whose coder is "NAME VALUE"; or the points of its
/// file that are of the meter's model, whose coder is their label. Files are made in a new folder inside `folder`, which
/// goes afterwards. Throws Error: ToolMissing; TimedOut; ToolFailed where a command ends otherwise than with status 0,
/// or writes no output, with the last lines of its errors; what `read_mesh` and `surface_distance` throw where it
/// writes no surface; CannotWrite, Cancelled; for points BadOption where the file has none of the model, or they are of
/// a surface with another count of vertices.
std::vector<CurvePoint> external_curve(const ExternalTool& tool, const Meter& meter, std::size_t samples,
                                       const std::string& folder, Progress& progress);

/// What a remesher makes of a surface, its levels recovered where it is no *.sr.ply. Throws the same, and the errors of
/// `recover_levels`.
SemiregularMesh external_remesh(const ExternalTool& tool, const Mesh& surface, const std::string& folder,
                                Progress& progress);

/// What is known of a tool's version: the first line that its version command prints, and a hash of the program's file, so that a
/// script that changes runs again; of points, of their file. Never throws for a tool that is not there.
std::string version_of(const ExternalTool& tool);

}  // namespace gsp
