#pragma once

#include <functional>
#include <string>

#include "experiments/external/external_tool.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "remesh/semiregular.h"

namespace gsp {

/// One point of a codec: what `encode` made for a value, and what `decode` made of that.
struct CodedSurface {
  std::string value;
  std::size_t bytes = 0;  ///< size of the file
  Mesh decoded;
};

/// Runs a codec for each of its values and hands over each point as soon as it is there, in their order. The surface is
/// written once, PLY in single precision, other formats in decimals that keep double. Files are made in a new folder
/// inside `folder`, which goes afterwards. Throws Error: ToolMissing; TimedOut; ToolFailed where a command ends
/// otherwise than with status 0, or writes no output, with the last lines of its errors; what `read_mesh` throws where
/// it writes no surface, NonFinite and NoFaces where it has no area to measure; CannotWrite, Cancelled.
void run_codec(const ExternalTool& tool, const Mesh& surface, const std::string& folder, Progress& progress,
               const std::function<void(CodedSurface)>& point);

/// What a remesher makes of a surface for its value, its levels recovered where it is no *.sr.ply. Throws the same, and
/// the errors of `recover_levels`.
SemiregularMesh run_remesher(const ExternalTool& tool, const Mesh& surface, const std::string& folder,
                             Progress& progress);

/// The first line that the tool's version command prints in ten seconds; empty where there is no command, or it fails.
std::string printed_version(const ExternalTool& tool);

/// The files that the words of the tool's commands name, programs found by PATH included, and a points file: if one of
/// them changes, so may the results.
std::vector<std::string> files_of(const ExternalTool& tool);

}  // namespace gsp
