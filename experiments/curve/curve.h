#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/cells/cell_options.h"
#include "mesh/progress.h"

namespace gsp {

/// The coder of the row that tells at how many bytes Draco codes the input without loss. It is no point of a curve: the
/// steps between a grid and no grid at all have no points.
inline constexpr const char* kDracoLossless = "draco-lossless";

/// What the coder of a point begins with that was measured on another model than the row's: it is drawn, and no gain is
/// said of it.
inline constexpr const char* kAnotherModel = "another model: ";

/// One row of curve.csv: one decoded size of one method on one model. Distances are relative to the input's
/// bounding-box diagonal, bytes are those that were decoded. Units and meanings stand in point_fields.cpp.
struct CurvePoint {
  std::string model;
  std::string method;  ///< gsp, maps, maps-smoothed, hybrid, or an anchor of `anchor_words`
  double gamma = 0.0, mu = 0.0;
  int replicate = 0;
  int base_vertices = 0, base_faces = 0, level = 0;
  std::string wavelet, coder;
  std::size_t bytes = 0;
  double bits_per_vertex = 0.0;  ///< of the input
  int faces = 0;                 ///< of the decoded surface
  double rms_forward = 0.0, rms_backward = 0.0, rms = 0.0, hausdorff = 0.0;
  double psnr_db = 0.0;
  std::size_t samples = 0;
  double standard_error_db = 0.0;
  double remesh_error = 0.0;  ///< ceiling of the method's curve; 0 for the anchors
  std::uint64_t seed = 0;
  std::string version;  ///< of the gsp that measured it
  std::string options;  ///< those without a column of their own, as "name=value name=value"
};

/// Everything measured on one model.
struct CurveRun {
  std::vector<CurvePoint> points;
  std::vector<OmegaRecord> omega;
};

struct CurveOptions {
  ParameterizeOptions parameterize;
  std::vector<Method> methods = {Method::Gsp, Method::MapsSmoothed};
  RemeshOptions remesh;
  /// What the vertices above the base are; each has curves of its own. `remesh.kind` does not count.
  std::vector<RemeshKind> kinds = {RemeshKind::Parametric};
  EncodeOptions encode;
  /// How each size is coded. Streams of their own for each size cost about ten times the coding of the embedded one
  /// each.
  std::vector<StreamMode> modes = {StreamMode::Embedded};
  std::vector<std::size_t> budgets;  ///< bytes; empty: 256, 512, 1024, ... up to the whole stream
  std::size_t samples = 200000;      ///< per direction and point; decimations, which have many points, take half
  std::uint64_t seed = 1;
  /// How often the maps are made, 1 to kMostReplicates: as replicates 0, 1, ... of `parameterize`, whose own number
  /// says nothing here. The anchors are measured once.
  int replicates = 1;
  bool anchors = true;  ///< the curves of `anchor_words`
  /// Called with all that is measured so far after each method, so that an interrupt loses at most one of them.
  std::function<void(const CurveRun&)> on_progress;
};

/// The main job on one surface: parameterize by every method after one simplification, remesh, encode by every mode,
/// decode at each budget, measure against the input; then the anchors. Budgets that do not hold a stream's header are
/// left out. Throws what its stages throw.
CurveRun rate_distortion_curve(const Mesh& mesh, const std::string& model, const CurveOptions& options,
                               Progress& progress);

}  // namespace gsp
