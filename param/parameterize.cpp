#include "param/parameterize.h"

#include <iomanip>
#include <optional>
#include <sstream>

#include "mesh/atomic_file.h"
#include "mesh/topology.h"
#include "param/folds.h"
#include "param/global_system.h"
#include "param/maps_smoothing.h"
#include "param/refine.h"
#include "param/relax_corners.h"
#include "param/repair.h"
#include "param/simplify.h"
#include "param/stretch.h"
#include "param/weights.h"

namespace gsp {

namespace {

/// How solving and relaxing alternate; radii in base edges, relaxation below 1/2 so that regions never meet.
struct Schedule {
  double relaxation_radius;
  double held_radius;  ///< see solve_global
};

/// The paper's own first; where its solution cannot be untangled, the vertices beside the corners are held more and more.
constexpr Schedule kSchedules[] = {{0.45, 0.0}, {0.45, 0.2}, {0.33, 0.1}, {0.33, 0.2}, {0.25, 0.1}, {0.25, 0.2}};

void check_options(const ParameterizeOptions& options) {
  if (options.base_vertices != 0 && options.base_vertices < 4)
    throw Error(Cause::BadOption, "base vertices must be at least 4, or 0 for the automatic number");
  if (!(options.gamma >= 0.0) || !(options.mu >= 0.0))
    throw Error(Cause::BadOption, "gamma and mu must not be negative");
  if (options.relaxations < 0) throw Error(Cause::BadOption, "the number of relaxations must not be negative");
}

std::vector<std::string> provenance(const ParameterizeOptions& options, Method method, const Atlas& atlas) {
  const auto line = [](const char* key, auto value) {
    std::ostringstream text;
    text << key << ' ' << std::setprecision(17) << value;
    return text.str();
  };
  return {line("method", method_name(method)),         line("base_vertices", atlas.base.vertex_count()),
          line("base_vertices_asked", options.base_vertices), line("gamma", options.gamma),
          line("mu", options.mu),                      line("relaxations", options.relaxations)};
}

void refine_for_map(Atlas& atlas, Progress& progress) {
  const int added = refine_at_corners(atlas);
  if (added > 0) progress.note(std::to_string(added) + " vertices were added beside patch corners");
}

/// Alternates global solves and corner relaxation (§3.3, steps 2 to 4) and keeps the round of least stretch: relaxation
/// removes folds and shear, but carried on it drives the corners toward a conformal map, which starves long limbs.
void solve_and_relax(Atlas& atlas, const Schedule& schedule, const ParameterizeOptions& options,
                     ParameterizeResult& result, Progress& progress) {
  place_boundary(atlas);
  const auto weights = mean_value_weights(*atlas.surface);
  Atlas best;
  double best_stretch = 0.0;
  for (int round = 0;; ++round) {
    progress.report("solve and relax", double(round) / (options.relaxations + 1));
    const int moved = round == 0 && options.relaxations == 0 ? 0 : relax_corners(atlas, weights, schedule.relaxation_radius);
    solve_global(atlas, weights, options.relaxations == 0 ? 0.0 : schedule.held_radius);
    const double stretch = l2_stretch(atlas);
    if (round == 0 || stretch < best_stretch) {
      best = atlas;
      best_stretch = stretch;
      result.relaxation_rounds = round;
    }
    if (round >= options.relaxations || moved == 0) break;
  }
  atlas = std::move(best);
}

/// Smallest regions first, so that as little as possible of the smooth solution is replaced.
void untangle(Atlas& atlas, Progress& progress) {
  progress.report("untangle", 0.0);
  const auto weights = mean_value_weights(*atlas.surface);
  for (double radius : {0.08, 0.12, 0.18, 0.27, 0.4}) settle_corners(atlas, weights, radius);
  repair_folds(atlas, weights, progress);
}

/// The paper's method with the repair: goes through the schedules until one gives a valid map.
/// Throws the first schedule's Error(InvalidMap) where none does.
Atlas smooth_map(const Atlas& initial, const ParameterizeOptions& options, ParameterizeResult& result,
                 Progress& progress) {
  std::optional<Error> first_failure;
  for (const Schedule& schedule : kSchedules) {
    Atlas atlas = initial;
    try {
      refine_for_map(atlas, progress);
      solve_and_relax(atlas, schedule, options, result, progress);
      refine_for_map(atlas, progress);
      result.flips_before_repair = static_cast<int>(find_folds(atlas).faces.size());
      untangle(atlas, progress);
      for (int b = 0; b < atlas.base.vertex_count(); ++b)
        result.corners_moved += atlas.base.vertices[b] != initial.base.vertices[b];
      return atlas;
    } catch (const Error& error) {
      if (error.cause() != Cause::InvalidMap) throw;
      progress.note(std::string(error.what()) + "; trying the next schedule");
      if (!first_failure) first_failure = error;
    }
  }
  throw *first_failure;
}

ParameterizeResult finish(Atlas atlas, Method method, const ParameterizeOptions& options, Progress& progress) {
  ParameterizeResult result;
  if (method == Method::MapsSmoothed) smooth_by_loop(atlas, progress);
  if (method == Method::Gsp) atlas = smooth_map(atlas, options, result, progress);
  result.map = atlas.finish(provenance(options, method, atlas));
  if (method == Method::Gsp) {
    const MapCheck check = check_map(result.map);
    if (!check.valid()) {
      std::ostringstream why;
      why << "the map is not valid: " << check.flipped_faces << " flipped faces, " << check.wrong_angle_vertices
          << " vertices with a wrong angle, " << check.mismatched_edges << " mismatched edges, relative area error "
          << check.area_error;
      throw Error(Cause::InvalidMap, why.str());
    }
  }
  return result;
}

}  // namespace

const char* method_name(Method method) {
  switch (method) {
    case Method::Gsp: return "gsp";
    case Method::Maps: return "maps";
    case Method::MapsSmoothed: return "maps-smoothed";
  }
  return "unknown";
}

std::vector<ParameterizeResult> parameterize_all(const Mesh& mesh, const std::vector<Method>& methods,
                                                 const ParameterizeOptions& options, Progress& progress) {
  check_options(options);
  require_parameterizable(mesh);
  Mesh refined = mesh;
  const int added = split_boundary_chords(refined);
  if (added > 0) progress.note(std::to_string(added) + " interior edges between boundary vertices were split");
  SimplifyResult simplified = simplify(std::make_shared<const Surface>(std::move(refined)), options, progress);
  if (simplified.atlas.base.vertex_count() > options.base_vertices && options.base_vertices > 0)
    progress.note("no further vertex can be removed: the base has " +
                  std::to_string(simplified.atlas.base.vertex_count()) + " vertices instead of " +
                  std::to_string(options.base_vertices));
  std::vector<ParameterizeResult> results;
  for (Method method : methods) {
    results.push_back(finish(simplified.atlas, method, options, progress));
    results.back().omega = simplified.omega;
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
