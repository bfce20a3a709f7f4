#pragma once

#include "experiments/cells/recipe.h"

namespace gsp {

/// What is known of a tool's version: the first line that its version command prints, and hashes of the files that its
/// commands name, the program among them, so that a script that changes runs again. Runs the version command. Never
/// throws for a tool that is not there.
std::string external_version(const ExternalTool& tool);

/// The recipe with the versions of its external methods, each asked for once.
Recipe with_external_versions(Recipe recipe);

}  // namespace gsp
