#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "experiments/curve/curve.h"

namespace gsp {

/// Where a field stands in a row.
using PointMember =
    std::variant<std::string CurvePoint::*, double CurvePoint::*, int CurvePoint::*, std::uint64_t CurvePoint::*>;

/// One column of a curve. All that must be known about it stands here once: curve.csv, the table `point` of a store,
/// the JSON of workers and of the report page, and the table in README.md follow from it, so a new column is one entry
/// in `point_fields`.
struct PointField {
  const char* name;     ///< column of curve.csv, key in JSON
  const char* unit;     ///< "dB", "bytes", "diagonals"; empty for words and counts
  const char* meaning;  ///< for people: a phrase without a full stop
  PointMember member;
  /// True where a measurement fills it in, so that a store keeps it; the others follow from the cell and its remesh.
  bool measured = false;
};

/// All fields, in the order of the columns of curve.csv.
const std::vector<PointField>& point_fields();

/// The measured ones among them.
const std::vector<PointField>& measured_fields();

/// README.md's table of the columns, a line each: "| psnr_db | dB | ... |".
std::string point_fields_table();

}  // namespace gsp
