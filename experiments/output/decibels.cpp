#include "experiments/output/decibels.h"

#include <fmt/format.h>

namespace gsp {

std::string db_text(double db, int digits) { return std::isinf(db) ? "exact" : fmt::format("{:.{}f}", db, digits); }

}  // namespace gsp
