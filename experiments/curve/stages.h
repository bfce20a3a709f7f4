#pragma once

#include <string>
#include <vector>

#include "experiments/cells/cell_options.h"
#include "experiments/curve/curve.h"
#include "experiments/curve/meter.h"

namespace gsp {

/// What the rows of curve.csv say about a remesh; all zero for the anchors.
struct RemeshShape {
  int base_vertices = 0, base_faces = 0, level = 0;
  double remesh_error = 0.0;  ///< larger RMS of both directions over the input's bounding-box diagonal
};

/// A remesh and how far it is from the input: the ceiling of every curve coded from it.
struct MeasuredRemesh {
  SemiregularMesh mesh;
  CurvePoint distance;
  RemeshShape shape;
};

// The stages after the map, as `gsp curve` runs them in memory and `gsp sweep` from files.

/// Throws what `surface_distance` throws.
MeasuredRemesh measured(SemiregularMesh remesh, const Meter& meter, std::size_t samples, Progress& progress);

/// At an automatic level by `remesh_by_rate`. Throws what `remesh` and `surface_distance` throw.
MeasuredRemesh measured_remesh(const Parameterization& map, const RemeshOptions& options, const Meter& meter,
                               std::size_t samples, Progress& progress);

/// Rows for every budget of `byte_budgets`, decoded side by side and measured. Throws what `decode` throws.
std::vector<CurvePoint> decoded_curve(const Bytes& stream, const std::vector<std::size_t>& budgets, const Meter& meter,
                                      std::size_t samples, Progress& progress);

/// A stream of its own for every budget that `decoded_curve` would decode of `embedded`, the remesh's embedded stream
/// of the same options; made side by side. Throws what `encode_fixed` throws.
std::vector<Bytes> fixed_streams(const SemiregularMesh& mesh, const EncodeOptions& options, const Bytes& embedded,
                                 const std::vector<std::size_t>& budgets, Progress& progress);

/// A row for each stream, the whole of it decoded. Throws what `decode` throws.
std::vector<CurvePoint> decoded_streams(const std::vector<Bytes>& streams, const Meter& meter, std::size_t samples,
                                        Progress& progress);

/// Rows of an anchor of `anchor_words`; decimations, which have many points, take half of the samples.
std::vector<CurvePoint> anchor_curve(const std::string& method, const Meter& meter, std::size_t samples,
                                     Progress& progress);

/// The budgets of a stream: those wanted (or 256, 512, 1024, ...) that hold its header and are shorter than it, and the
/// whole of it last.
std::vector<std::size_t> byte_budgets(const std::vector<std::size_t>& wanted, std::size_t header, std::size_t whole);

/// Fills in the columns of a row that follow from the options and the remesh, not from the measurement.
void describe(CurvePoint& row, const CellOptions& options, const RemeshShape& shape);

}  // namespace gsp
