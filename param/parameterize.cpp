#include "param/parameterize.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <Eigen/Geometry>

#include "mesh/atomic_file.h"
#include "mesh/topology.h"
#include "param/folds.h"
#include "param/global_system.h"
#include "param/lower_distortion.h"
#include "param/maps_smoothing.h"
#include "param/refine.h"
#include "param/relax_corners.h"
#include "param/repair.h"
#include "param/simplify.h"
#include "param/smooth.h"
#include "param/stretch.h"
#include "param/valid_map.h"
#include "param/weights.h"

namespace gsp {

namespace {

constexpr double kRelaxationRadius = 0.45;  // in base edges; below 1/2 regions never meet
constexpr int kMostRefinements = 4;         // of the surface around folds that do not come free
constexpr int kAutomaticShare = 64;         // vertices per base vertex, of which the automatic stop falls short or not
constexpr double kLongestEdge = 0.25;       // of the edge of an equilateral patch of mean area

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

[[noreturn]] void give_up(const Folds& folds) {
  const std::string counts = std::to_string(folds.faces.size()) + " faces stay folded in their chart and " +
                             std::to_string(folds.vertices.size()) + " vertices wrongly wound";
  if (folds.faces.empty()) throw Error(Cause::InvalidMap, counts, Element::Vertex, folds.vertices.front());
  throw Error(Cause::InvalidMap, counts, Element::Face, folds.faces.front());
}

/// Splits the edges of all faces that touch a fold.
void refine_folds(Atlas& atlas, const Folds& folds) {
  const Surface& surface = *atlas.surface;
  std::vector<int> vertices = folds.vertices;
  for (int f : folds.faces) vertices.insert(vertices.end(), surface.mesh.faces[f].begin(), surface.mesh.faces[f].end());
  std::vector<int> edges;
  for (int v : vertices) {
    const int start = surface.halfedges.outgoing[v];
    int h = start;
    do {
      for (int k = 0; k < 3; ++k) edges.push_back(surface.edge_of[h - h % 3 + k]);
      h = surface.halfedges.rotate_ccw(h);
    } while (h >= 0 && h != start);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  split_edges(atlas, edges);
}

/// The paper's method (§3.3, steps 2 to 4): alternates global solves and corner relaxation and keeps the round of least
/// stretch, since carried on they drive the corners toward a conformal map, which starves long limbs. Some faces may be folded.
Atlas solve_and_relax(Atlas atlas, const ParameterizeOptions& options, ParameterizeResult& result, Progress& progress) {
  seat_boundary(atlas);
  atlas.position = boundary_by_arc_length(atlas);
  auto weights = mean_value_weights(*atlas.surface);
  const double eta = getenv("ETA") ? atof(getenv("ETA")) : 0.0;
  const std::vector<char> interior = interior_vertices(atlas);
  Atlas best;
  double best_stretch = 0.0;
  for (int round = 0;; ++round) {
    progress.report("solve and relax", double(round) / (options.relaxations + 1));
    const int moved =
        options.relaxations == 0 ? 0 : relax_corners(atlas, weights, kRelaxationRadius, Folding::Allowed);
    atlas.position = solve_global(atlas, weights, interior_vertices(atlas));
    for (std::size_t v = 0; v < interior.size(); ++v)
      if (atlas.corner[v] < 0 && atlas.patch[v]>=0 && !atlas.surface->halfedges.boundary_vertex(v)) atlas.reassign(static_cast<int>(v));
    const double stretch = l2_stretch(atlas);
    if (getenv("VM")) printf("round %d: moved %d folds %zu+%zu stretch %.4f\n", round, moved, find_folds(atlas).faces.size(), find_folds(atlas).vertices.size(), stretch);
    if (round == 0 || stretch < best_stretch) {
      best = atlas;
      best_stretch = stretch;
      result.relaxation_rounds = round;
    }
    if (round >= options.relaxations || moved == 0) break;
    if (eta > 0) { const auto sigma = vertex_stretch(atlas); for (int e = 0; e < atlas.surface->edge_count(); ++e) { int h = atlas.surface->edge_halfedge[e]; int a = atlas.surface->halfedges.from(h), b = atlas.surface->halfedges.to(h); weights[e][0] /= std::pow(std::clamp(sigma[b],0.1,10.0), eta); weights[e][1] /= std::pow(std::clamp(sigma[a],0.1,10.0), eta);} }
  }
  return best;
}

/// Takes the folds out of a map, refining the surface around those that do not come free at once.
Folds unfold(Atlas& atlas, int refinements, Progress& progress) {
  repair_folds(atlas, progress);
  Folds folds = find_folds(atlas);
  if (getenv("VM")) printf("unfold: %zu %zu\n", folds.faces.size(), folds.vertices.size());
  for (int i = 0; i < refinements && !folds.none(); ++i) {
    refine_folds(atlas, folds);
    repair_folds(atlas, progress);
    folds = find_folds(atlas);
    if (getenv("VM")) printf("unfold refined: %zu %zu\n", folds.faces.size(), folds.vertices.size());
  }
  return folds;
}

/// The smooth map without its folds. Where they do not come free, the solution is approached from the simplification's
/// unfolded map instead, over maps that have none.
Atlas smooth_map(const SimplifyResult& simplified, const ParameterizeOptions& options, ParameterizeResult& result,
                 Progress& progress) {
  Atlas smooth = simplified.atlas;
  refine_at_corners(smooth);
  if (!getenv("STRAT")) smooth = solve_and_relax(std::move(smooth), options, result, progress);
  const Folds folds = find_folds(smooth);
  result.flips_before_repair = static_cast<int>(folds.faces.size());
  if (getenv("CHAIN")) return smooth;
  Atlas atlas = smooth;
  if (!getenv("STRAT") && unfold(atlas, 0, progress).none()) {
    for (int v = 0; v < (int)atlas.patch.size(); ++v)
      if (atlas.corner[v] < 0 && atlas.patch[v]>=0 && !atlas.surface->halfedges.boundary_vertex(v)) atlas.reassign(v);
  return atlas; }

  atlas = unfolded_map(simplified.atlas.surface, simplified.removals, progress);
  refine_at_corners(atlas);
  seat_boundary(atlas);
  const Folds left = unfold(atlas, kMostRefinements, progress);
  if (!left.none()) give_up(left);
  const auto weights = mean_value_weights(*atlas.surface);
  if (getenv("STRAT")) {
    int rounds = atoi(getenv("STRAT"));
    for (int r = 0; r < rounds; ++r) {
      int m = relax_corners(atlas, weights, kRelaxationRadius, Folding::Refused);
      result.held_vertices = solve_without_folds(atlas, weights, progress);
      printf("guarded round %d moved %d held %d stretch %.4f\n", r, m, result.held_vertices, l2_stretch(atlas));
    }
    return atlas;
  }
  int n = drag_corners(atlas, weights, kRelaxationRadius, smooth.base.vertices);
  if (getenv("VM")) printf("dragged: %d of %d\n", n, atlas.base.vertex_count());
  result.held_vertices = solve_without_folds(atlas, weights, progress);
  if (getenv("VM")) printf("held %d stretch %.4f (%.4f)\n", result.held_vertices, l2_stretch(atlas), l2_stretch(smooth));
  return atlas;
}

/// Edge of the equilateral triangle as large as a patch on average, for so many base vertices.
double patch_edge(const Mesh& mesh, int base_vertices) {
  double area = 0.0;
  for (const Triangle& t : mesh.faces)
    area += 0.5 * (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).norm();
  const double patches = 2.0 * std::max(base_vertices > 0 ? base_vertices : mesh.vertex_count() / kAutomaticShare, 4);
  return std::sqrt(area / patches / kChartArea);
}

ParameterizeResult finish(const SimplifyResult& simplified, Method method, const ParameterizeOptions& options,
                          Progress& progress) {
  ParameterizeResult result;
  Atlas atlas = method == Method::Gsp ? smooth_map(simplified, options, result, progress) : simplified.atlas;
  if (method == Method::MapsSmoothed) smooth_by_loop(atlas, progress);
  if (getenv("IT") && method == Method::Gsp) for (int k = 0; k < 4; ++k) { if (getenv("RELAX") && k) { auto w = mean_value_weights(*atlas.surface); int m = relax_corners(atlas, w, atof(getenv("RELAX")), Folding::Refused); if(getenv("VM")) printf("relaxed %d: stretch %.4f\n", m, l2_stretch(atlas)); } bool ok = lower_distortion(atlas, atoi(getenv("IT"))/4, progress); if(getenv("VM")) printf("lower %d stretch %.4f\n", ok, l2_stretch(atlas)); }
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
  int added = split_boundary_chords(refined);
  if (added > 0) progress.note(std::to_string(added) + " interior edges between boundary vertices were split");
  added = split_long_edges(refined, kLongestEdge * patch_edge(refined, options.base_vertices));
  if (added > 0) progress.note(std::to_string(added) + " vertices were added on edges that are long for the patches");
  SimplifyResult simplified = simplify(std::make_shared<const Surface>(std::move(refined)), options, progress);
  if (simplified.atlas.base.vertex_count() > options.base_vertices && options.base_vertices > 0)
    progress.note("no further vertex can be removed: the base has " +
                  std::to_string(simplified.atlas.base.vertex_count()) + " vertices instead of " +
                  std::to_string(options.base_vertices));
  std::vector<ParameterizeResult> results;
  for (Method method : methods) {
    results.push_back(finish(simplified, method, options, progress));
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
