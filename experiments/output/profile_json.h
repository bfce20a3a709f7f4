#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "mesh/profile.h"

namespace gsp {

/// An array with an object a step: {"step", "depth", "runs", "seconds", "cpu_seconds", "peak_megabytes"}.
nlohmann::ordered_json profile_json(const std::vector<ProfileStep>& steps);
/// The inverse. Throws nlohmann::json::exception where a member is missing or of another type.
std::vector<ProfileStep> profile_of_json(const nlohmann::ordered_json& steps);

}  // namespace gsp
