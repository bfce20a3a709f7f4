#include "experiments/curve/curve_csv.h"

#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "experiments/curve/point_fields.h"
#include "experiments/output/csv.h"
#include "experiments/output/quoting.h"
#include "mesh/atomic_file.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

CurvePoint point_of(const CsvRow& row) {
  CurvePoint point;
  for (const PointField& field : point_fields()) {
    // A file from before there were replicates holds one of each, the first.
    if (field.member == PointMember(&CurvePoint::replicate) && !row.has(field.name)) continue;
    // Decibels alone may be infinite (output/decibels.h).
    const auto* number = std::get_if<double CurvePoint::*>(&field.member);
    if (number && std::string_view(field.unit) == "dB" && row.text(field.name) == "inf")
      point.** number = std::numeric_limits<double>::infinity();
    else
      std::visit([&](auto member) { row.read(field.name, point.*member); }, field.member);
  }
  return point;
}

// Numbers as the shortest decimals that read back as the same.
std::string text_of(const PointField& column, const CurvePoint& point) {
  return std::visit([&](auto member) { return csv_field(fmt::format("{}", point.*member)); }, column.member);
}

}  // namespace

std::vector<CurvePoint> read_curve_csv(const std::string& path) try {
  std::vector<CurvePoint> points;
  for (const CsvRow& row : csv_rows(read_text(path))) points.push_back(point_of(row));
  return points;
} catch (const Error& error) {
  throw error.within(path);
}

void write_curve_csv(const std::string& path, const std::vector<CurvePoint>& points) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  const char* separator = "";
  for (const PointField& column : point_fields()) {
    out << separator << column.name;
    separator = ",";
  }
  out << '\n';
  for (const CurvePoint& point : points) {
    separator = "";
    for (const PointField& column : point_fields()) {
      out << separator << text_of(column, point);
      separator = ",";
    }
    out << '\n';
  }
  file.commit();
}

std::set<std::string> stems_of_earlier_run(const std::string& folder) {
  std::set<std::string> stems;
  try {
    for (const CurvePoint& point : read_curve_csv(folder + "/curve.csv")) stems.insert(file_stem(point.model));
  } catch (const Error&) {  // none, or another's
  }
  return stems;
}

}  // namespace gsp
