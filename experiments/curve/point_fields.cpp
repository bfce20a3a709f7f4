#include "experiments/curve/point_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace gsp {

const std::vector<PointField>& point_fields() {
  using P = CurvePoint;
  constexpr bool kMeasured = true;
  constexpr const char* kDiagonals = "diagonals";
  static const std::vector<PointField> all = {
      {"model", "", "file name without folder and ending", &P::model},
      {"method", "",
       "gsp; maps (the initial map); maps-smoothed (the same, smoothed by Loop on the parameters); hybrid (the same, "
       "relaxed by pairs of patches); draco; decimate-draco; lindstrom-turk-draco; or the name of an external method",
       &P::method},
      {"gamma", "", "weight of triangle shape in the simplification's cost; 0 for the anchors", &P::gamma},
      {"mu", "", "weight of area dispersion in the simplification's cost; 0 for the anchors", &P::mu},
      {"replicate", "",
       "0: the surface as it is; others repeat the map with prices of vertex removals changed by at most 1e-4, to "
       "learn "
       "what chance does; 0 for the anchors, which have no such choice",
       &P::replicate},
      {"base_vertices", "", "vertices of the base complex; 0 for the anchors", &P::base_vertices},
      {"base_faces", "", "faces of the base complex; 0 for the anchors", &P::base_faces},
      {"level", "", "quadrisections of the base complex; 0 for the anchors", &P::level},
      {"wavelet", "", "transform; empty for the anchors", &P::wavelet},
      {"coder", "",
       "`gsp`: a prefix of the embedded stream; `gsp-fixed`: a stream for that size alone; or Draco with its bits per "
       "coordinate (`draco-qp11`) or without quantization (`draco-lossless`, which is no point of a curve); of an "
       "external method "
       "its name and value, or its point's label and note",
       &P::coder, kMeasured},
      {"bytes", "bytes", "decoded", &P::bytes, kMeasured},
      {"bits_per_vertex", "bits", "8·bytes over the vertices of the input", &P::bits_per_vertex, kMeasured},
      {"faces", "", "of the decoded surface", &P::faces, kMeasured},
      {"rms_forward", kDiagonals, "root mean square distance from the input to the decoded surface", &P::rms_forward,
       kMeasured},
      {"rms_backward", kDiagonals, "the same from the decoded surface to the input", &P::rms_backward, kMeasured},
      {"rms", kDiagonals, "the larger of the two", &P::rms, kMeasured},
      {"hausdorff", kDiagonals, "largest sampled distance, both ways: a lower bound", &P::hausdorff, kMeasured},
      {"psnr_db", "dB", "20·log10(1 / rms): the peak is the diagonal", &P::psnr_db, kMeasured},
      {"samples", "", "per direction, area-stratified", &P::samples, kMeasured},
      {"standard_error_db", "dB", "of psnr_db, from the sampling", &P::standard_error_db, kMeasured},
      {"remesh_error", kDiagonals,
       "rms of the uncoded remesh, the ceiling of the method's curve; 0 for the anchors, which have none",
       &P::remesh_error},
      {"seed", "", "of the samples", &P::seed, kMeasured},
      {"version", "", "of the gsp that measured it, with the commit", &P::version},
      {"options", "",
       "those that have no column, as `name=value name=value`; `positions` says what the remesh's vertices are, "
       "`kind` how many numbers each has",
       &P::options},
  };
  return all;
}

const std::vector<PointField>& measured_fields() {
  static const std::vector<PointField> measured = [] {
    std::vector<PointField> fields;
    std::copy_if(point_fields().begin(), point_fields().end(), std::back_inserter(fields),
                 [](const PointField& field) { return field.measured; });
    return fields;
  }();
  return measured;
}

std::string point_fields_table() {
  std::string table = "| column | unit | meaning |\n|---|---|---|\n";
  for (const PointField& field : point_fields())
    table += fmt::format("| {} | {} | {} |\n", field.name, field.unit, field.meaning);
  return table;
}

}  // namespace gsp
