#include "experiments/base/base_by_rate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "coder/anchors.h"
#include "coder/codec.h"
#include "mesh/topology.h"
#include "metrics/psnr.h"
#include "metrics/surface_distance.h"
#include "param/parameterize.h"
#include "remesh/remesh.h"
#include "remesh/semiregular.h"

namespace gsp {

namespace {

constexpr int kFaces = 2500;            // of the stand-in
constexpr double kRefinement = 8.0;     // faces of a remesh for each of the stand-in, within a factor of two
constexpr std::size_t kSamples = 5000;  // of a distance: 0.1 dB
constexpr std::size_t kBudgets[] = {1024, 2048, 4096, 8192};
constexpr int kMostAroundVertex = 256;  // faces; the time of a decimation grows with the cube of that
constexpr double kOctave = 12.0;        // dB lost for each halving of a budget that does not hold a header

constexpr double kSmallest = 15.0, kLargest = 1600.0;  // vertices, of the ladder
constexpr int kFewestPerBase = 8;                      // vertices of the surface for each of the base
constexpr double kLarger = 1.2;                        // than asked for is another size
constexpr int kFirst[] = {2, 4, 6};                    // steps of the ladder: 30, 60, 120

int size_at(int step) { return static_cast<int>(std::lround(kSmallest * std::pow(2.0, 0.5 * step))); }

int largest_valence(const Mesh& mesh) {
  std::vector<int> valence(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.faces)
    for (int v : t) ++valence[v];
  return *std::max_element(valence.begin(), valence.end());
}

/// Judges sizes on a stand-in.
class Judge {
 public:
  Judge(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress)
      : mesh_(stand_in(mesh, progress)), tree_(mesh_), options_(options), progress_(progress) {
    options_.method = Method::Gsp;
    options_.replicate = 0;
    options_.objective = Objective::Distortion;
    options_.relaxations = 0;
    options_.base_edges = BaseEdges::Keep;
    options_.features.reset();  // edges of the surface, which the stand-in does not have
    const double most = std::min(kLargest, mesh.vertex_count() / static_cast<double>(kFewestPerBase));
    while (size_at(last_ + 1) <= most) ++last_;
  }

  int last() const { return last_; }

  /// What a step of the ladder is worth; nothing where it has no map, or is the same base as a larger step.
  std::optional<double> at(int step) {
    if (step < 0 || step > last_ || kLarger * size_at(step) < least_) return std::nullopt;
    if (const auto known = known_.find(step); known != known_.end()) return known->second;
    progress_.report("choose the base by rate", std::min(0.9, 0.1 * static_cast<double>(known_.size())));
    return known_[step] = worth(size_at(step));
  }

  std::vector<BaseTried> tried;

 private:
  static Mesh stand_in(const Mesh& mesh, Progress& progress) {
    if (mesh.face_count() <= kFaces) return mesh;
    // Flat fans have no volume to go by, and some surfaces no collapse that is left.
    for (const Decimation decimation : {Decimation::Volume, Decimation::Quadrics}) {
      std::vector<Mesh> fewer = decimate(mesh, {kFaces}, decimation, progress);
      if (!fewer.empty()) return std::move(fewer.front());
    }
    return mesh;
  }

  std::optional<double> worth(int size) try {
    Progress silent;
    options_.base_vertices = size;
    const ParameterizeResult map = parameterize(mesh_, options_, silent);
    RemeshOptions remeshing;
    remeshing.level = first_level_with(map.map.base.face_count(), kRefinement * mesh_.face_count() / 2.0);
    EncodeOptions coding;
    coding.wavelet = Wavelet::ButterflyLifted;
    const Bytes stream = encode(remesh(map.map, remeshing, silent), coding, silent);
    tried.push_back({size, map.map.base.vertex_count(), mean_psnr(stream)});
    if (tried.back().base_vertices > kLarger * size) {
      least_ = std::max(least_, tried.back().base_vertices);
      return std::nullopt;
    }
    return tried.back().psnr_db;
  } catch (const Error& error) {
    if (error.cause() == Cause::Cancelled) throw;
    return std::nullopt;
  }

  double mean_psnr(const Bytes& stream) const {
    Progress silent;
    DistanceOptions sampling;
    sampling.samples = kSamples;
    const std::size_t least = header_bytes(stream);
    double sum = 0.0;
    for (std::size_t budget : kBudgets) {
      const std::size_t bytes = std::max(budget, least);
      const Mesh decoded = decode(stream, bytes).mesh();
      sum += diagonal_psnr(surface_distance(mesh_, tree_, decoded, sampling, silent)).db -
             kOctave * std::log2(static_cast<double>(bytes) / static_cast<double>(budget));
    }
    return sum / static_cast<double>(std::size(kBudgets));
  }

  const Mesh mesh_;
  const SurfaceTree tree_;
  ParameterizeOptions options_;
  Progress& progress_;
  int last_ = -1;
  int least_ = 0;  ///< base vertices at which the simplification had to stop
  std::map<int, std::optional<double>> known_;
};

}  // namespace

BaseByRate base_by_rate(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress) {
  require_parameterizable(mesh);  // no size would do
  BaseByRate result;
  if (largest_valence(mesh) > kMostAroundVertex) {
    progress.note("the base is chosen by the paper's stop: a vertex has more than " +
                  std::to_string(kMostAroundVertex) + " faces, which the choice by rate takes too long for");
    return result;
  }
  progress.report("choose the base by rate", 0.0);
  Judge judge(mesh, options, progress);
  if (judge.last() < 0) return result;
  int best = -1;
  const auto look_at = [&](int step) {
    const std::optional<double> worth = judge.at(step);
    if (!worth || (best >= 0 && *worth <= *judge.at(best))) return false;
    best = step;
    return true;
  };
  for (int step : kFirst) look_at(std::min(step, judge.last()));
  for (int step = 1 + kFirst[2]; best < 0 && step <= judge.last(); ++step) look_at(step);
  for (int stride : {2, 1})
    while (best >= 0) {
      const int from = best;
      look_at(from - stride);
      look_at(from + stride);
      if (best == from) break;
    }
  if (best >= 0) result.base_vertices = size_at(best);
  result.tried = std::move(judge.tried);
  return result;
}

namespace {

/// The next sizes up to one with room for all features, which the stand-in may have lost.
int with_room_for_features(const Mesh& mesh, ParameterizeOptions options) {
  const int chosen = options.base_vertices;
  while (choose_features(mesh, options).given_way > 0) {
    options.base_vertices = static_cast<int>(std::lround(std::numbers::sqrt2 * options.base_vertices));
    if (options.base_vertices > mesh.vertex_count() / kFewestPerBase) return chosen;
  }
  return options.base_vertices;
}

}  // namespace

ParameterizeOptions with_base_by_rate(const Mesh& mesh, ParameterizeOptions options, Progress& progress) {
  if (options.base_vertices != kBaseByRate) return options;
  const auto step = progress.step("choose base by rate");
  options.base_vertices = base_by_rate(mesh, options, progress).base_vertices;
  if (options.base_vertices != kBaseByOmega) options.base_vertices = with_room_for_features(mesh, options);
  if (options.base_vertices != kBaseByOmega)
    progress.note("by rate the base is to have " + std::to_string(options.base_vertices) + " vertices");
  return options;
}

}  // namespace gsp
