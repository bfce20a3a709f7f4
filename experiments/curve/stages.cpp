#include "experiments/curve/stages.h"

#include <algorithm>

#include "experiments/base/level_by_rate.h"
#include "experiments/curve/anchor_curves.h"
#include "mesh/parallel.h"

namespace gsp {

namespace {

constexpr const char* kDecodeAndMeasure = "decode and measure";

// Does work of one thread for each of `count` things side by side, as many at a time as there are threads.
template <class Work>
void side_by_side(std::size_t count, const char* stage, Progress& progress, const Work& work) {
  const std::size_t threads = static_cast<std::size_t>(thread_count());
  for (std::size_t first = 0; first < count; first += threads) {
    progress.report(stage, static_cast<double>(first) / static_cast<double>(count));
    parallel_for(std::min(threads, count - first), 1, [&](std::size_t begin, std::size_t end) {
      Progress silent;
      for (std::size_t i = first + begin; i < first + end; ++i) work(i, silent);
    });
  }
}

}  // namespace

MeasuredRemesh measured(SemiregularMesh remesh, const Meter& meter, std::size_t samples, Progress& progress) {
  MeasuredRemesh result;
  result.mesh = std::move(remesh);
  progress.report("measure the remesh", 0.0);
  Progress silent;
  result.distance = meter.measure(result.mesh.mesh(), 0, samples, silent);
  result.shape = {result.mesh.base_vertices, static_cast<int>(result.mesh.base_faces.size()), result.mesh.level,
                  result.distance.rms};
  return result;
}

MeasuredRemesh measured_remesh(const Parameterization& map, const RemeshOptions& options, const Meter& meter,
                               std::size_t samples, Progress& progress) {
  return measured(remesh_by_rate(map, options, progress), meter, samples, progress);
}

std::vector<CurvePoint> decoded_curve(const Bytes& stream, const std::vector<std::size_t>& wanted, const Meter& meter,
                                      std::size_t samples, Progress& progress) {
  const std::vector<std::size_t> budgets = byte_budgets(wanted, header_bytes(stream), stream.size());
  progress.report(kDecodeAndMeasure, 0.0);
  // Prefixes have the faces of the whole stream, unless they are too short for its level, and nearly its places.
  const Mesh whole = decode(stream, stream.size()).mesh();
  const SurfaceTree tree(whole);
  std::vector<CurvePoint> points(budgets.size());
  side_by_side(budgets.size(), kDecodeAndMeasure, progress, [&](std::size_t i, Progress& silent) {
    if (budgets[i] == stream.size()) {
      points[i] = meter.measure(whole, tree, budgets[i], samples, silent);
      return;
    }
    const Mesh mesh = decode(stream, budgets[i]).mesh();
    const SurfaceTree own = mesh.faces.size() == whole.faces.size() ? SurfaceTree(mesh, tree) : SurfaceTree(mesh);
    points[i] = meter.measure(mesh, own, budgets[i], samples, silent);
  });
  return points;
}

std::vector<Bytes> fixed_streams(const SemiregularMesh& mesh, const EncodeOptions& options, const Bytes& embedded,
                                 const std::vector<std::size_t>& wanted, Progress& progress) {
  const std::vector<std::size_t> budgets = byte_budgets(wanted, header_bytes(embedded), embedded.size());
  std::vector<Bytes> streams(budgets.size());
  side_by_side(budgets.size(), "encode each size", progress,
               [&](std::size_t i, Progress& silent) { streams[i] = encode_fixed(mesh, options, budgets[i], silent); });
  return streams;
}

std::vector<CurvePoint> decoded_streams(const std::vector<Bytes>& streams, const Meter& meter, std::size_t samples,
                                        Progress& progress) {
  std::vector<CurvePoint> points(streams.size());
  side_by_side(streams.size(), kDecodeAndMeasure, progress, [&](std::size_t i, Progress& silent) {
    points[i] = meter.measure(decode(streams[i], streams[i].size()).mesh(), streams[i].size(), samples, silent);
  });
  return points;
}

std::vector<CurvePoint> anchor_curve(const std::string& method, const Meter& meter, std::size_t samples,
                                     Progress& progress) {
  if (method == "draco") return draco_curve(meter, samples, progress);
  const Decimation decimation = method == "decimate-draco" ? Decimation::Quadrics : Decimation::Volume;
  return decimate_draco_curve(meter, decimation, samples / 2, progress);
}

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

void describe(CurvePoint& row, const CellOptions& options, const RemeshShape& shape) {
  row.method = options.method;
  row.options = further_options(options);
  if (!has_remesh(options)) return;
  if (has_map(options)) {
    row.gamma = options.parameterize.gamma;
    row.mu = options.parameterize.mu;
    row.replicate = options.parameterize.replicate;
  }
  row.base_vertices = shape.base_vertices;
  row.base_faces = shape.base_faces;
  row.level = shape.level;
  row.wavelet = wavelet_name(options.encode.wavelet);
  row.coder = coder_name(options.mode);
  row.remesh_error = shape.remesh_error;
}

}  // namespace gsp
