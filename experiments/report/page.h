#pragma once

#include <string>

namespace gsp {

/// The page as one file, with styles, scripts and three.js in it: everything but the views. `run_json` is what page.js
/// reads. The parts are compiled in (experiments/play/page_parts.h).
std::string report_page(const std::string& run_json);

}  // namespace gsp
