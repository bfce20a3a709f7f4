#include "experiments/curve/external_curves.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/external/points_file.h"
#include "experiments/external/run_tool.h"

namespace gsp {

namespace {

std::vector<CurvePoint> codec_curve(const ExternalTool& tool, const Meter& meter, std::size_t samples,
                                    const std::string& folder, Progress& progress) {
  std::vector<CurvePoint> points;
  run_codec(tool, meter.mesh(), folder, progress, [&](const CodedSurface& coded) {
    Progress silent;
    points.push_back(meter.measure(coded.decoded, coded.bytes, samples, silent));
    points.back().coder = tool.name + (coded.value.empty() ? "" : ' ' + coded.value);
  });
  return points;
}

// A row of numbers that were measured elsewhere says nothing of what they do not hold.
CurvePoint foreign_row(const ForeignPoint& foreign, const Meter& meter) {
  CurvePoint row;
  row.model = meter.model();
  if (!foreign.measured_on.empty()) row.coder = kAnotherModel + foreign.measured_on;
  if (!foreign.label.empty()) row.coder += (row.coder.empty() ? "" : ": ") + foreign.label;
  if (!foreign.note.empty()) row.coder += (row.coder.empty() ? "" : ": ") + foreign.note;
  row.bytes = foreign.bytes;
  row.bits_per_vertex = 8.0 * static_cast<double>(foreign.bytes) / meter.mesh().vertex_count();
  row.psnr_db = foreign.psnr_db;
  row.rms = std::pow(10.0, -foreign.psnr_db / 20.0);
  return row;
}

std::vector<CurvePoint> file_curve(const ExternalTool& tool, const Meter& meter) {
  std::vector<CurvePoint> points;
  const int vertices = meter.mesh().vertex_count(), faces = meter.mesh().face_count();
  for (const ForeignPoint& foreign : read_points_file(tool.points))
    if (foreign.is_of(meter.model(), vertices, faces)) points.push_back(foreign_row(foreign, meter));
  if (points.empty())
    throw Error(Cause::BadOption, fmt::format("{} has no points of {}, a surface of {} vertices and {} faces",
                                              tool.points, meter.model(), vertices, faces));
  return points;
}

}  // namespace

std::vector<CurvePoint> external_curve(const ExternalTool& tool, const Meter& meter, std::size_t samples,
                                       const std::string& folder, Progress& progress) {
  return tool.kind == ExternalTool::Kind::Points ? file_curve(tool, meter)
                                                 : codec_curve(tool, meter, samples, folder, progress);
}

}  // namespace gsp
