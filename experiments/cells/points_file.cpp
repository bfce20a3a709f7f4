#include "experiments/cells/points_file.h"

#include "experiments/cells/csv.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

namespace gsp {

std::vector<ForeignPoint> read_points_file(const std::string& path) try {
  std::vector<ForeignPoint> points;
  for (const CsvRow& row : csv_rows(read_file(path))) {
    ForeignPoint& point = points.emplace_back();
    point.model = row.text("model");
    if (row.has("vertices")) row.read("vertices", point.vertices.emplace());
    row.read("bytes", point.bytes);
    row.read("psnr_db", point.psnr_db);
    if (point.bytes == 0) throw Error(Cause::Malformed, "a point of no bytes", Element::Line, row.line());
    if (row.has("label")) point.label = row.text("label");
    if (row.has("note")) point.note = row.text("note");
  }
  return points;
} catch (const Error& error) {
  throw error.within(path);
}

}  // namespace gsp
