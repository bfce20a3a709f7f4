#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/cells/recipe.h"
#include "experiments/store/store.h"

namespace gsp {

/// The cells of a recipe with the keys of their stages, and their surfaces. A surface that cannot be read is a model
/// with its cause, whose cells have no keys. Versions of external methods are asked for here. `keep` receives every
/// surface that could be read, with its key.
Plan make_plan(const Recipe& recipe, const std::function<void(const std::string& key, const Mesh&)>& keep);

/// Where the surface of that key lies in a store, relative to its folder.
std::string surface_path(const std::string& key);

/// The key of a stage: of its name, its algorithm's version, its options and the key of what it works on.
std::string stage_key(StageKind kind, const CellOptions& options, const std::string& input);

}  // namespace gsp
