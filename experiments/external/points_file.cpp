#include "experiments/external/points_file.h"

#include "experiments/output/csv.h"
#include "mesh/error.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

bool says(const CsvRow& row, const char* column) { return row.has(column) && !row.text(column).empty(); }

}  // namespace

bool ForeignPoint::is_of(const std::string& name, int vertex_count, int face_count) const {
  if (!vertices && !faces) return model == name;
  return vertices.value_or(vertex_count) == vertex_count && faces.value_or(face_count) == face_count;
}

std::vector<ForeignPoint> read_points_file(const std::string& path) try {
  std::vector<ForeignPoint> points;
  for (const CsvRow& row : csv_rows(read_text(path))) {
    ForeignPoint& point = points.emplace_back();
    point.model = row.text("model");
    if (says(row, "vertices")) row.read("vertices", point.vertices.emplace());
    if (says(row, "faces")) row.read("faces", point.faces.emplace());
    row.read("bytes", point.bytes);
    row.read("psnr_db", point.psnr_db);
    if (point.bytes == 0) throw Error(Cause::Malformed, "a point of no bytes", Element::Line, row.line());
    if (row.has("measured_on")) point.measured_on = row.text("measured_on");
    if (row.has("label")) point.label = row.text("label");
    if (row.has("note")) point.note = row.text("note");
  }
  return points;
} catch (const Error& error) {
  throw error.within(path);
}

}  // namespace gsp
