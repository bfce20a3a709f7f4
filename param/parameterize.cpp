#include "param/parameterize.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

#include <Eigen/Geometry>

#include "mesh/atomic_file.h"
#include "mesh/topology.h"
#include "param/linear_map.h"
#include "param/maps_smoothing.h"
#include "param/relax_patch_pairs.h"
#include "param/simplify.h"
#include "param/smooth_levels.h"
#include "param/weights.h"

namespace gsp {

namespace {

// An automatic base is taken to have a vertex for so many of the surface, but of a finely sampled one at most so many times the
// root of their number: the sampling does not make it more detailed.
constexpr double kAutomaticShare = 64.0, kAutomaticRoot = 3.0;
constexpr int kPairPasses = 3;              // of the hybrid baseline; more bring it nearer to the global solution
constexpr int kLargerLevel = 4;             // than the last level that could not be joined
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
          line("base_edges", base_edges_name(options.base_edges)),
          line("input_vertices", input.vertex_count()), line("input_faces", input.face_count())};
}

/// What the methods on one base complex share.
struct Start {
  std::optional<Atlas> maps;            ///< for the baselines alone
  std::optional<Atlas> injective;       ///< for Method::Gsp alone
  std::vector<int> base_vertices;       ///< of the surface, as the simplification left them
  SmoothingRecord smoothing;            ///< of `injective`
  std::vector<OmegaRecord> omega;
};

/// Makes the map without folds by the method and objective asked for, and counts how its corners moved.
Atlas smooth_map(const Start& start, const ParameterizeOptions& options, ParameterizeResult& result,
                 Progress& progress) {
  const Atlas atlas = options.objective == Objective::Linear
                          ? linear_map(*start.injective, options, result, progress)
                          : *start.injective;
  if (options.objective == Objective::Distortion) {
    result.relaxation_rounds = start.smoothing.rounds;
    result.base_edges_flipped = start.smoothing.edges_flipped;
  }
  for (int b = 0; b < atlas.base.vertex_count(); ++b)
    result.corners_moved += atlas.base.vertices[b] != start.base_vertices[b];
  return atlas;
}

/// Edge of the equilateral triangle as large as a patch on average, for so many base vertices.
double patch_edge(const Mesh& mesh, int base_vertices) {
  const double count = mesh.vertex_count(), expected = std::min(count / kAutomaticShare, kAutomaticRoot * std::sqrt(count));
  const double patches = 2.0 * std::max(base_vertices > 0 ? base_vertices : expected, 4.0);
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

/// Simplifies the surface and, where it is wanted, smooths the map without folds. Where the levels cannot be joined the last of
/// them is made larger, at the end as large as the surface.
Start make_start(const Mesh& mesh, const std::vector<Method>& methods, const ParameterizeOptions& options,
                 Progress& progress) {
  const auto surface = std::make_shared<const Surface>(refined(mesh, options, progress));
  const auto injective = std::count(methods.begin(), methods.end(), Method::Gsp);
  const int whole = surface->mesh.vertex_count();
  ParameterizeOptions smoothing = options;
  if (options.objective == Objective::Linear) {  // it relaxes the corners of its own solution
    smoothing.relaxations = 0;
    smoothing.base_edges = BaseEdges::Keep;
  }
  Start start;
  for (int coarsest = injective > 0 ? coarsest_level(*surface, options) : whole;;) {
    SimplifyResult simplified = simplify(surface, options, coarsest, progress);
    start.omega = std::move(simplified.omega);
    start.base_vertices = remaining_vertices(*surface, simplified.removals);
    start.maps.reset();
    if (injective < static_cast<int>(methods.size())) start.maps = maps_of(simplified);
    if (injective == 0) break;
    std::optional<SmoothedMap> smoothed = smooth_levels(std::move(simplified), smoothing, progress);
    const bool joined = smoothed && (coarsest >= whole || check_map(smoothed->atlas.finish({})).valid());
    if (joined) {
      start.smoothing = smoothed->record;
      start.injective = std::move(smoothed->atlas);
      break;
    }
    coarsest = std::min(whole, kLargerLevel * coarsest);
    progress.note("the levels of the map could not be joined; the last one starts with " + std::to_string(coarsest) +
                  " vertices instead");
  }
  if (start.injective) {
    const int added = start.injective->surface->mesh.vertex_count() - surface->mesh.vertex_count();
    if (added > 0) progress.note(std::to_string(added) + " vertices were added where the map needs more freedom");
  }
  const int left = static_cast<int>(start.base_vertices.size());
  if (options.base_vertices > 0 && left > options.base_vertices)
    progress.note("no further vertex can be removed: the base has " + std::to_string(left) + " vertices instead of " +
                  std::to_string(options.base_vertices));
  return start;
}

ParameterizeResult finish(const Mesh& input, const Start& start, Method method, const ParameterizeOptions& options,
                          Progress& progress) {
  ParameterizeResult result;
  Atlas atlas = method == Method::Gsp ? smooth_map(start, options, result, progress) : *start.maps;
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
  options.base_edges = BaseEdges::Keep;
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

const char* base_edges_name(BaseEdges base_edges) { return base_edges == BaseEdges::Flip ? "flip" : "keep"; }

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
  const Start start = make_start(mesh, methods, options, progress);
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
