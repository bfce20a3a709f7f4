#include "experiments/curve/curve.h"

#include <fmt/format.h>

#include "experiments/base/base_by_rate.h"
#include "experiments/curve/stages.h"

namespace gsp {

namespace {

CellOptions cell_options(const CurveOptions& options, const std::string& method, const RemeshOptions& remesh = {},
                         StreamMode mode = StreamMode::Embedded) {
  return normalized({.method = method,
                     .parameterize = options.parameterize,
                     .remesh = remesh,
                     .encode = options.encode,
                     .mode = mode,
                     .budgets = options.budgets,
                     .samples = options.samples,
                     .seed = options.seed});
}

// The rows of one method and kind: its remesh, coded by every mode and decoded at every budget.
std::vector<CurvePoint> method_curve(const ParameterizeResult& result, const std::string& method, RemeshKind kind,
                                     const CurveOptions& options, const Meter& meter, Progress& progress) {
  RemeshOptions remesh_options = options.remesh;
  remesh_options.kind = kind;
  const MeasuredRemesh remesh = measured_remesh(result.map, remesh_options, meter, options.samples, progress);
  const Bytes embedded = encode(remesh.mesh, options.encode, progress);
  std::vector<CurvePoint> points;
  for (StreamMode mode : options.modes) {
    std::vector<CurvePoint> rows =
        mode == StreamMode::Embedded
            ? decoded_curve(embedded, options.budgets, meter, options.samples, progress)
            : decoded_streams(fixed_streams(remesh.mesh, options.encode, embedded, options.budgets, progress), meter,
                              options.samples, progress);
    for (CurvePoint& row : rows) describe(row, cell_options(options, method, remesh_options, mode), remesh.shape);
    points.insert(points.end(), rows.begin(), rows.end());
  }
  return points;
}

}  // namespace

CurveRun rate_distortion_curve(const Mesh& mesh, const std::string& model, const CurveOptions& options,
                               Progress& progress) {
  CurveRun run;
  const auto append = [&](const std::vector<CurvePoint>& points) {
    run.points.insert(run.points.end(), points.begin(), points.end());
    if (options.on_progress) options.on_progress(run);
  };
  const ParameterizeOptions parameterizing = with_base_by_rate(mesh, options.parameterize, progress);
  const Meter meter(mesh, model, options.seed);
  for (int replicate = 0; replicate < options.replicates; ++replicate) {
    CurveOptions once = options;
    once.parameterize = parameterizing;
    once.parameterize.replicate = replicate;
    Progress repeated = options.replicates > 1
                            ? progress.within(fmt::format("replicate {} of {}", replicate + 1, options.replicates))
                            : progress;
    const std::vector<ParameterizeResult> results = parameterize_all(mesh, once.methods, once.parameterize, repeated);
    if (!results.empty() && replicate == 0) run.omega = results.front().omega;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::string method = method_name(once.methods[i]);
      Progress named = repeated.within(method);
      for (RemeshKind kind : once.kinds) append(method_curve(results[i], method, kind, once, meter, named));
    }
  }
  for (const std::string& anchor : anchor_words()) {
    if (!options.anchors) break;
    std::vector<CurvePoint> points = anchor_curve(anchor, meter, options.samples, progress);
    for (CurvePoint& point : points) describe(point, cell_options(options, anchor), {});
    append(points);
  }
  return run;
}

}  // namespace gsp
