#include "experiments/base/map_worth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "metrics/psnr.h"
#include "param/parameterize.h"
#include "remesh/remesh.h"

namespace gsp {

namespace {

constexpr std::size_t kSamples = 5000;  // of a distance: 0.1 dB
constexpr double kOctave = 12.0;        // dB lost for each halving of a budget that does not hold a header
constexpr double kOnePoint = 6.0;       // dB of a prefix that decodes to nothing but one point

/// Cancels when `progress` does, and keeps its notes to itself.
Progress quiet(Progress& progress, const char* stage) {
  return Progress([&progress, stage](const std::string&, double) {
    progress.report(stage, 0.5);
    return true;
  });
}

}  // namespace

Bytes rated_stream(const SemiregularMesh& mesh, Progress& progress) {
  EncodeOptions coding;
  coding.wavelet = Wavelet::ButterflyLifted;
  return encode(mesh, coding, progress);
}

std::optional<double> prefix_psnr(const Mesh& surface, const SurfaceTree& tree, const Bytes& stream, std::size_t bytes,
                                  const DistanceOptions& sampling, Progress& progress) {
  const Mesh decoded = decode(stream, bytes).mesh();
  if (!(surface_area(decoded) > 0.0)) return std::nullopt;
  return diagonal_psnr(surface_distance(surface, tree, decoded, sampling, progress)).db;
}

MapWorth::MapWorth(Mesh mesh, std::vector<std::size_t> budgets, double fewest_faces)
    : mesh_(std::move(mesh)), tree_(mesh_), budgets_(std::move(budgets)), fewest_faces_(fewest_faces) {}

std::optional<MapWorth::Value> MapWorth::of(ParameterizeOptions options, Progress& progress) const try {
  options.method = Method::Gsp;
  options.replicate = 0;
  options.tries = 1;
  options.objective = Objective::Distortion;
  options.relaxations = ParameterizeOptions{}.relaxations;
  options.base_edges = BaseEdges::Keep;
  Progress inner = quiet(progress, "choose the base by rate");
  const Parameterization map = parameterize(mesh_, options, inner).map;
  RemeshOptions remeshing;
  remeshing.most_fit_rounds = 1;
  remeshing.level = first_level_with(map.base.face_count(), fewest_faces_);
  const Bytes stream = rated_stream(remesh(map, remeshing, inner), inner);
  return Value{map.base.vertex_count(), mean_psnr(stream, inner)};
} catch (const Error& error) {
  if (error.cause() == Cause::Cancelled) throw;
  return std::nullopt;
}

double MapWorth::mean_psnr(const Bytes& stream, Progress& progress) const {
  DistanceOptions sampling;
  sampling.samples = kSamples;
  const std::size_t header = header_bytes(stream);
  double sum = 0.0;
  for (std::size_t budget : budgets_) {
    const std::size_t bytes = std::max(budget, header);
    sum += prefix_psnr(mesh_, tree_, stream, bytes, sampling, progress).value_or(kOnePoint);
    sum -= kOctave * std::log2(static_cast<double>(bytes) / static_cast<double>(budget));
  }
  return sum / static_cast<double>(budgets_.size());
}

}  // namespace gsp
