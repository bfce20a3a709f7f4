#pragma once

#include <nlohmann/json_fwd.hpp>

#include "param/map/parameterization.h"

namespace gsp::cli {

/// What `check_map` found, for print_report.
nlohmann::ordered_json check_report(const MapCheck& check);

}  // namespace gsp::cli
