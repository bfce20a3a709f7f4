#pragma once

#include <string>
#include <vector>

#include "experiments/curve.h"

namespace gsp {

/// Writes curve.csv: a header line, then one row per point (columns: README.md, "curve.csv"). Replaces the file as a
/// whole. A text with a comma, quote or line break is quoted as RFC 4180 has it. Throws Error(CannotWrite).
void write_curve_csv(const std::string& path, const std::vector<CurvePoint>& points);

}  // namespace gsp
