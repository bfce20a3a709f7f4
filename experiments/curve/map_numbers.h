#pragma once

#include <map>
#include <string>

#include "param/parameterize.h"

namespace gsp {

/// What a store says about a map (names: `StageResult::numbers`). `input_vertices` are those before refinement.
/// O(F log F).
std::map<std::string, double> map_numbers(const ParameterizeResult& result, int input_vertices);

}  // namespace gsp
