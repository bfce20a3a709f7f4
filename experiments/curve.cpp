#include "experiments/curve.h"

#include <algorithm>

#include "experiments/anchor_curves.h"
#include "experiments/meter.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

// The rows of one method: its remesh coded once and decoded at every budget.
std::vector<CurvePoint> method_curve(const ParameterizeResult& result, const std::string& method, const Meter& meter,
                                     const CurveOptions& options, Progress& progress) {
  Progress silent;
  const SemiregularMesh semiregular = remesh(result.map, options.remesh, progress);
  progress.report(method + ": measure the remesh", 0.0);
  const double remesh_error = meter.measure(semiregular.mesh(), 0, options.samples, silent).rms;
  const Bytes stream = encode(semiregular, options.encode, progress);

  const std::vector<std::size_t> budgets = byte_budgets(options.budgets, header_bytes(stream), stream.size());
  std::vector<CurvePoint> points(budgets.size());
  // Decoding has one thread, so prefixes are decoded side by side, as many at a time as there are threads.
  const std::size_t threads = static_cast<std::size_t>(thread_count());
  for (std::size_t first = 0; first < budgets.size(); first += threads) {
    progress.report(method + ": decode and measure", static_cast<double>(first) / static_cast<double>(budgets.size()));
    parallel_for(std::min(threads, budgets.size() - first), 1, [&](std::size_t begin, std::size_t end) {
      Progress unheard;
      for (std::size_t i = first + begin; i < first + end; ++i)
        points[i] = meter.measure(decode(stream, budgets[i]).mesh(), budgets[i], options.samples, unheard);
    });
  }
  for (CurvePoint& point : points) {
    point.method = method;
    point.gamma = options.parameterize.gamma;
    point.mu = options.parameterize.mu;
    point.base_vertices = semiregular.base_vertices;
    point.base_faces = static_cast<int>(semiregular.base_faces.size());
    point.level = semiregular.level;
    point.wavelet = wavelet_name(options.encode.wavelet);
    point.coder = "gsp";
    point.remesh_error = remesh_error;
  }
  return points;
}

}  // namespace

std::vector<std::size_t> byte_budgets(const std::vector<std::size_t>& wanted, std::size_t header, std::size_t whole) {
  std::vector<std::size_t> budgets;
  const auto add = [&](std::size_t bytes) {
    if (bytes >= header && bytes < whole) budgets.push_back(bytes);
  };
  for (std::size_t bytes : wanted) add(bytes);
  if (wanted.empty())
    for (std::size_t bytes = 256; bytes < whole; bytes *= 2) add(bytes);
  budgets.push_back(whole);
  return budgets;
}

CurveRun rate_distortion_curve(const Mesh& mesh, const std::string& model, const CurveOptions& options,
                               Progress& progress) {
  CurveRun run;
  const auto append = [&](const std::vector<CurvePoint>& points) {
    run.points.insert(run.points.end(), points.begin(), points.end());
    if (options.on_progress) options.on_progress(run);
  };
  const std::vector<ParameterizeResult> results =
      parameterize_all(mesh, options.methods, options.parameterize, progress);
  if (!results.empty()) run.omega = results.front().omega;

  const Meter meter(mesh, model, options.seed);
  for (std::size_t i = 0; i < results.size(); ++i)
    append(method_curve(results[i], method_name(options.methods[i]), meter, options, progress));
  if (options.anchors) {
    append(draco_curve(meter, options.samples, progress));
    append(decimate_draco_curve(meter, options.samples / 2, progress));
  }
  return run;
}

}  // namespace gsp
