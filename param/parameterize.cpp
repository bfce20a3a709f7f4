#include "param/parameterize.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

#include <Eigen/Geometry>

#include "mesh/atomic_file.h"
#include "mesh/topology.h"
#include "param/best_map.h"
#include "param/descend_corners.h"
#include "param/folds.h"
#include "param/linear_map.h"
#include "param/lower_distortion.h"
#include "param/maps_smoothing.h"
#include "param/relax_corners.h"
#include "param/relax_patch_pairs.h"
#include "param/repair.h"
#include "param/simplify.h"
#include "param/weights.h"

namespace gsp {

namespace {

constexpr double kRoughly = 2e-3, kFinely = 1e-4;  // gain of a step that ends lowering the distortion, between and after relaxations
constexpr int kRings = 16;                    // of the discs that are untangled in the end
constexpr int kAutomaticShare = 64;         // vertices per base vertex, of which the automatic stop falls short or not
constexpr int kPairPasses = 3;              // of the hybrid baseline; more bring it nearer to the global solution
constexpr double kLongestEdge = 0.25;       // of the edge of an equilateral patch of mean area

void check_options(const ParameterizeOptions& options) {
  if (options.base_vertices != 0 && options.base_vertices < 4)
    throw Error(Cause::BadOption, "base vertices must be at least 4, or 0 for the automatic number");
  if (!(options.gamma >= 0.0) || !(options.mu >= 0.0))
    throw Error(Cause::BadOption, "gamma and mu must not be negative");
  if (options.relaxations < 0) throw Error(Cause::BadOption, "the number of relaxations must not be negative");
}

std::vector<std::string> provenance(const Mesh& input, const ParameterizeOptions& options, Method method,
                                    const Atlas& atlas) {
  const auto line = [](const char* key, auto value) {
    std::ostringstream text;
    text << key << ' ' << std::setprecision(17) << value;
    return text.str();
  };
  return {line("method", method_name(method)),         line("base_vertices", atlas.base.vertex_count()),
          line("base_vertices_asked", options.base_vertices), line("gamma", options.gamma),
          line("mu", options.mu),                      line("relaxations", options.relaxations),
          line("objective", objective_name(options.objective)),
          line("weights", weights_name(options.weights)), line("corners", corners_name(options.corners)),
          line("input_vertices", input.vertex_count()), line("input_faces", input.face_count())};
}

[[noreturn]] void give_up(const Folds& folds) {
  const std::string counts = std::to_string(folds.faces.size()) + " faces stay folded in their chart and " +
                             std::to_string(folds.vertices.size()) + " vertices wrongly wound";
  if (folds.faces.empty()) throw Error(Cause::InvalidMap, counts, Element::Vertex, folds.vertices.front());
  throw Error(Cause::InvalidMap, counts, Element::Face, folds.faces.front());
}

/// What the methods on one base complex share.
struct Start {
  Atlas maps;
  std::optional<RefinedMap> injective;  ///< for Method::Gsp alone
  std::vector<OmegaRecord> omega;
};

/// The map of least distortion: from the initial map without its folds, lowering the energy and relaxing the corners in turn.
Atlas low_distortion_map(const Start& start, const ParameterizeOptions& options,
                         ParameterizeResult& result, Progress& progress) {
  result.flips_before_repair = static_cast<int>(find_folds(start.maps).faces.size());
  RefinedMap rough = *start.injective;
  lower_distortion(rough.atlas, kRoughly, progress);
  // Where the map has become smooth it needs fewer added vertices.
  Atlas atlas = coarsen(std::move(rough)).atlas;
  const LinearWeights weights(*atlas.surface, options.weights);
  BestMap best;
  best.offer(atlas, 0);
  for (int round = 1; round <= options.relaxations; ++round) {
    const int moved = options.corners == Corners::Gradient
                          ? descend_corners(atlas, options.objective, kRelaxationRadius, Folding::Refused)
                          : relax_corners(atlas, weights, kRelaxationRadius, Folding::Refused);
    if (moved == 0) break;
    lower_distortion(atlas, kRoughly, progress);
    best.offer(atlas, round);
  }
  result.relaxation_rounds = best.round();
  atlas = best.atlas();
  lower_distortion(atlas, kFinely, progress);
  return atlas;
}

/// Makes the map without folds by the method and objective asked for, and counts how its corners moved.
Atlas smooth_map(const Start& start, const ParameterizeOptions& options, ParameterizeResult& result,
                 Progress& progress) {
  const Atlas atlas = options.objective == Objective::Linear
                          ? linear_map(start.injective->atlas, options, result, progress)
                          : low_distortion_map(start, options, result, progress);
  for (int b = 0; b < atlas.base.vertex_count(); ++b)
    result.corners_moved += atlas.base.vertices[b] != start.maps.base.vertices[b];
  return atlas;
}

/// Edge of the equilateral triangle as large as a patch on average, for so many base vertices.
double patch_edge(const Mesh& mesh, int base_vertices) {
  const double patches = 2.0 * std::max(base_vertices > 0 ? base_vertices : mesh.vertex_count() / kAutomaticShare, 4);
  return std::sqrt(surface_area(mesh) / patches / kChartArea);
}

/// The surface with edges short enough for the patches, and none that joins two boundaries.
Mesh refined(Mesh mesh, const ParameterizeOptions& options, Progress& progress) {
  int added = split_boundary_chords(mesh);
  if (added > 0) progress.note(std::to_string(added) + " interior edges between boundary vertices were split");
  added = split_long_edges(mesh, kLongestEdge * patch_edge(mesh, options.base_vertices));
  if (added > 0) progress.note(std::to_string(added) + " vertices were added on edges that are long for the patches");
  return mesh;
}

/// Simplifies the surface, and makes the map without folds where it is asked for.
Start make_start(const Mesh& mesh, bool injective, const ParameterizeOptions& options, Progress& progress) {
  const auto surface = std::make_shared<const Surface>(refined(mesh, options, progress));
  SimplifyResult simplified = simplify(surface, options, progress);
  Start start{std::move(simplified.atlas), {}, std::move(simplified.omega)};
  if (injective) {
    start.injective = std::move(simplified.overlay).coarsened();
    Atlas& atlas = start.injective->atlas;
    const int added = atlas.surface->mesh.vertex_count() - surface->mesh.vertex_count();
    if (added > 0) progress.note(std::to_string(added) + " vertices were added where the map needs more freedom");
    const Folds folds = repair_folds(atlas, kRings, progress);
    if (!folds.none()) give_up(folds);
    atlas.reassign_all();
  }
  const int left = start.maps.base.vertex_count();
  if (options.base_vertices > 0 && left > options.base_vertices)
    progress.note("no further vertex can be removed: the base has " + std::to_string(left) + " vertices instead of " +
                  std::to_string(options.base_vertices));
  return start;
}

ParameterizeResult finish(const Mesh& input, const Start& start, Method method, const ParameterizeOptions& options,
                          Progress& progress) {
  ParameterizeResult result;
  Atlas atlas = method == Method::Gsp ? smooth_map(start, options, result, progress) : start.maps;
  if (method == Method::MapsSmoothed) smooth_by_loop(atlas, progress);
  if (method == Method::Hybrid)
    relax_patch_pairs(atlas, LinearWeights(*atlas.surface, options.weights), kPairPasses, progress);
  result.map = atlas.finish(provenance(input, options, method, atlas));
  if (method == Method::Gsp) {
    const MapCheck check = check_map(result.map);
    if (!check.valid()) {
      std::ostringstream why;
      why << "the map is not valid: " << check.flipped_faces << " flipped faces, " << check.wrong_angle_vertices
          << " vertices with a wrong angle, " << check.mismatched_edges << " mismatched edges, " << check.misplaced_vertices
          << " vertices outside their chart, relative area error " << check.area_error;
      throw Error(Cause::InvalidMap, why.str());
    }
  }
  return result;
}

}  // namespace

ParameterizeOptions paper_options() {
  ParameterizeOptions options;
  options.objective = Objective::Linear;
  options.weights = Weights::MeanValue;
  return options;
}

const char* objective_name(Objective objective) {
  return objective == Objective::Linear ? "linear" : "distortion";
}

const char* weights_name(Weights weights) {
  switch (weights) {
    case Weights::MeanValue: return "mean-value";
    case Weights::Cotangent: return "cotangent";
    case Weights::Uniform: return "uniform";
  }
  return "unknown";
}

const char* corners_name(Corners corners) { return corners == Corners::Gradient ? "gradient" : "relax"; }

const char* method_name(Method method) {
  switch (method) {
    case Method::Gsp: return "gsp";
    case Method::Maps: return "maps";
    case Method::MapsSmoothed: return "maps-smoothed";
    case Method::Hybrid: return "hybrid";
  }
  return "unknown";
}

std::vector<ParameterizeResult> parameterize_all(const Mesh& mesh, const std::vector<Method>& methods,
                                                 const ParameterizeOptions& options, Progress& progress) {
  check_options(options);
  require_parameterizable(mesh);
  const bool injective = std::find(methods.begin(), methods.end(), Method::Gsp) != methods.end();
  const Start start = make_start(mesh, injective, options, progress);
  std::vector<ParameterizeResult> results;
  for (Method method : methods) {
    results.push_back(finish(mesh, start, method, options, progress));
    results.back().omega = start.omega;
  }
  return results;
}

ParameterizeResult parameterize(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress) {
  return std::move(parameterize_all(mesh, {options.method}, options, progress).front());
}

void write_omega_csv(const std::string& path, const std::vector<OmegaRecord>& record) {
  AtomicFile file(path);
  file.stream() << "remaining_vertices,shape,dispersion,metric,omega\n" << std::setprecision(17);
  for (const OmegaRecord& r : record)
    file.stream() << r.remaining_vertices << ',' << r.shape << ',' << r.dispersion << ',' << r.metric << ',' << r.omega()
                  << '\n';
  file.commit();
}

}  // namespace gsp
