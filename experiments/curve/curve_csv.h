#pragma once

#include <set>
#include <string>
#include <vector>

#include "experiments/curve/curve.h"

namespace gsp {

/// Writes curve.csv: a header line, then one row per point (columns: README.md, "curve.csv"). Replaces the file as a
/// whole. A text with a comma, quote or line break is quoted as RFC 4180 has it. Throws Error(CannotWrite).
void write_curve_csv(const std::string& path, const std::vector<CurvePoint>& points);

/// Reads what `write_curve_csv` wrote, by the names of the columns; others are left alone, and a missing one is an
/// error. Throws Error: CannotOpen; Malformed with the line.
std::vector<CurvePoint> read_curve_csv(const std::string& path);

/// The surfaces of the curve.csv that an earlier run left in a folder, each once, as file names (`file_stem`). None
/// where there is no such table.
std::set<std::string> stems_of_earlier_run(const std::string& folder);

}  // namespace gsp
