#include "experiments/base/base_by_rate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "coder/anchors.h"
#include "experiments/base/map_worth.h"
#include "mesh/topology.h"
#include "param/creases/feature_budget.h"

namespace gsp {

namespace {

constexpr int kFaces = 10000;           // of the stand-in
constexpr int kMostAroundVertex = 256;  // faces; the time of a decimation grows with the cube of that
constexpr double kFewestFaces = 40000;  // of remeshes

constexpr double kSmallest = 15.0, kLargest = 1600.0;  // vertices, of the ladder
constexpr int kFewestPerBase = 8;                      // vertices of the surface for each of the base
constexpr double kFewestPerCreased = 4.0;              // the same where feature curves need room
constexpr int kMostJudged = 100000;                    // faces of a surface of which several maps are made for that
constexpr double kHopeless = 2.0;                      // dB behind a base without features, where none has enough room
constexpr double kLarger = 1.2;                        // than asked for is another size
constexpr int kFirst[] = {2, 4, 6};                    // steps of the ladder: 30, 60, 120
constexpr int kStride = 2;                             // between them

int size_at(int step) { return static_cast<int>(std::lround(kSmallest * std::pow(2.0, 0.5 * step))); }

int largest_valence(const Mesh& mesh) {
  std::vector<int> valence(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.faces)
    for (int v : t) ++valence[v];
  return *std::max_element(valence.begin(), valence.end());
}

/// The surface after decimation.
Mesh stand_in(const Mesh& mesh, Progress& progress) {
  if (mesh.face_count() <= kFaces) return mesh;
  // Flat fans have no volume to go by, and some surfaces no collapse that is left.
  for (const Decimation decimation : {Decimation::Volume, Decimation::Quadrics}) {
    std::vector<Mesh> fewer = decimate(mesh, {kFaces}, decimation, progress);
    if (!fewer.empty()) return std::move(fewer.front());
  }
  return mesh;
}

/// Judges sizes on a stand-in.
class Judge {
 public:
  Judge(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress)
      : worth_(stand_in(mesh, progress), kRatedBytes, kFewestFaces), options_(options), progress_(progress) {
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

  /// The step nearest to the peak of the parabola through a step, which is the best, and those `kStride` to either
  /// side. A single size is better or worse by chance, by some tenths of a dB. Nothing where one of them has no value.
  std::optional<int> peak_about(int step) {
    const std::optional<double> below = at(step - kStride), here = at(step), above = at(step + kStride);
    if (!below || !here || !above) return std::nullopt;
    const double bend = 2.0 * *here - *below - *above;
    if (!(bend > 0.0)) return step;
    return step + static_cast<int>(std::lround(kStride * (*above - *below) / (2.0 * bend)));
  }

  std::vector<BaseTried> tried;

 private:
  std::optional<double> worth(int size) {
    options_.base_vertices = size;
    const std::optional<MapWorth::Value> value = worth_.of(options_, progress_);
    if (!value) return std::nullopt;
    tried.push_back({size, value->base_vertices, value->psnr_db});
    if (value->base_vertices <= kLarger * size) return value->psnr_db;
    least_ = std::max(least_, value->base_vertices);
    return std::nullopt;
  }

  const MapWorth worth_;
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
  const auto climb = [&](int stride) {
    while (best >= 0) {
      const int from = best;
      look_at(from - stride);
      look_at(from + stride);
      if (best == from) break;
    }
  };
  climb(kStride);
  if (const std::optional<int> peak = best < 0 ? std::nullopt : judge.peak_about(best))
    best = *peak;
  else
    climb(1);
  if (best >= 0) result.base_vertices = size_at(best);
  result.tried = std::move(judge.tried);
  return result;
}

namespace {

/// The largest base of a creased surface.
int most_creased(const Mesh& mesh) {
  return static_cast<int>(std::min<double>(kLargest, mesh.vertex_count() / kFewestPerCreased));
}

/// The next size of the ladder that is `needed` or more, but at most `most`.
int with_room(int base_vertices, int needed, int most) {
  while (base_vertices < std::min(needed, most))
    base_vertices = std::min(most, static_cast<int>(std::lround(std::numbers::sqrt2 * base_vertices)));
  return base_vertices;
}

}  // namespace

ParameterizeOptions with_features_by_rate(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress) {
  const FeatureEdges features = wanted_features(mesh, options);
  if (features.empty()) return options;
  const int needed = base_for_all(feature_curves(mesh, features));
  if (options.base_vertices >= needed) return options;
  const int most = with_room(options.base_vertices, needed, most_creased(mesh));
  ParameterizeOptions chosen = options;
  if (mesh.face_count() > kMostJudged) {
    if (most >= needed) chosen.base_vertices = most;
    return chosen;
  }
  const auto step = progress.step("choose features by rate");
  // The stand-in may have lost curves, so the surface itself is judged.
  const MapWorth worth(mesh, kRatedBytes, kFewestFaces);
  constexpr double kNoMap = -std::numeric_limits<double>::infinity();
  const auto psnr = [&](const ParameterizeOptions& candidate) {
    const std::optional<MapWorth::Value> value = worth.of(candidate, progress);
    return value ? value->psnr_db : kNoMap;
  };
  ParameterizeOptions none = options;
  none.feature_degrees = kNoFeatures;
  const bool automatic = !options.features && options.feature_degrees == kAutoFeatures;
  const double without = automatic ? psnr(none) : kNoMap;

  ParameterizeOptions next = options;
  next.features = features;  // found once
  double best = psnr(next);
  const auto is_better = [&](int size) {
    next.base_vertices = size;
    const double db = psnr(next);
    if (db <= best) return false;
    best = db;
    chosen.base_vertices = size;
    return true;
  };
  if (best > without - kHopeless) {
    while (next.base_vertices < most && is_better(std::min(most, 2 * next.base_vertices))) continue;
    if (next.base_vertices < most) is_better(most);  // between some curves and all there may be a dip
  }
  if (without <= best) return chosen;
  progress.note("feature curves, for which the base has too little room, cost more bytes than they save: none is kept");
  return none;
}

ParameterizeOptions with_base_by_rate(const Mesh& mesh, ParameterizeOptions options, Progress& progress) {
  if (options.base_vertices != kBaseByRate) return options;
  const auto step = progress.step("choose base by rate");
  options.base_vertices = base_by_rate(mesh, options, progress).base_vertices;
  if (options.base_vertices == kBaseByOmega) return options;
  options = with_features_by_rate(mesh, options, progress);
  progress.note("by rate the base is to have " + std::to_string(options.base_vertices) + " vertices");
  return options;
}

}  // namespace gsp
