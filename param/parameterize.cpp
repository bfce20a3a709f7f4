#include "param/parameterize.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

#include "mesh/atomic_file.h"
#include "mesh/topology.h"
#include "param/atlas/split_edges.h"
#include "param/baselines/maps.h"
#include "param/baselines/maps_smoothing.h"
#include "param/baselines/relax_patch_pairs.h"
#include "param/creases/cut_surface.h"
#include "param/creases/glue_map.h"
#include "param/creases/settle_creases.h"
#include "param/linear/weights.h"
#include "param/shortening.h"
#include "param/simplify/simplify.h"
#include "param/stages/linear_map.h"
#include "param/stages/smooth_levels.h"
#include "param/stages/try_bases.h"
#include "param/stages/valid_map.h"

namespace gsp {

namespace {

// An automatic base is taken to have a vertex for so many of the surface, but of a finely sampled one at most so many
// times the root of their number: the sampling does not make it more detailed.
constexpr double kAutomaticShare = 64.0, kAutomaticRoot = 3.0;
constexpr int kPairPasses = 3;   // of the hybrid baseline; more bring it nearer to the global solution
constexpr int kLargerLevel = 4;  // than the last level that could not be joined
// Vertices up to which a surface is made in one level before larger ones are tried (bench/README.md, "Thin faces").
constexpr int kOneLevel = 20000;
constexpr double kLongestEdge = 0.25;                        // of the edge of an equilateral patch of mean area
constexpr double kMostPerFace = 12.0, kMostPerPatch = 64.0;  // vertices added for it

void check_options(const ParameterizeOptions& options) {
  if (options.base_vertices != kBaseByOmega && options.base_vertices < 4)
    throw Error(Cause::BadOption,
                "base vertices must be at least 4, or chosen by the paper's stop; a base by rate is chosen before "
                "(base_by_rate)");
  if (options.base_vertices == kBaseByOmega && options.priority == Priority::Maps)
    throw Error(Cause::BadOption,
                "the paper's stop is about the order of Ω: MAPS' priority needs a number of base vertices");
  if (!(options.gamma >= 0.0) || !(options.mu >= 0.0))
    throw Error(Cause::BadOption, "gamma and mu must not be negative");
  if (options.tries < 1 || options.tries > ParameterizeOptions::kMostTries)
    throw Error(Cause::BadOption, "the number of bases to try must be 1 to 64");
  if (options.replicate < 0) throw Error(Cause::BadOption, "the number of the replicate must not be negative");
  if (options.feature_degrees < kAutoFeatures || options.feature_degrees > 179)
    throw Error(Cause::BadOption, "the angle of features must be 1 to 179 degrees, none or found by itself");
  if (options.relaxations < 0) throw Error(Cause::BadOption, "the number of relaxations must not be negative");
}

std::vector<std::string> provenance(const Mesh& input, const ParameterizeOptions& options, Method method,
                                    const BaseComplex& base) {
  const auto line = [](const char* key, auto value) {
    std::ostringstream text;
    text << key << ' ' << std::setprecision(17) << value;
    return text.str();
  };
  std::vector<std::string> lines = {line("method", method_name(method)),
                                    line("base_vertices", base.vertex_count()),
                                    line("base_vertices_asked", options.base_vertices),
                                    line("gamma", options.gamma),
                                    line("mu", options.mu),
                                    line("relaxations", options.relaxations),
                                    line("objective", objective_name(options.objective)),
                                    line("weights", weights_name(options.weights)),
                                    line("corners", corners_name(options.corners)),
                                    line("base_edges", base_edges_name(options.base_edges)),
                                    line("input_vertices", input.vertex_count()),
                                    line("input_faces", input.face_count())};
  if (!base.creases.empty()) lines.push_back(line("creases", base.creases.size()));
  if (options.priority == Priority::Maps) lines.push_back(line("priority", priority_name(options.priority)));
  if (options.tries > 1) lines.push_back(line("tries", options.tries));
  if (options.replicate > 0) lines.push_back(line("replicate", options.replicate));
  return lines;
}

/// What one kind of method starts from: a map without folds, and the cut surface that it is a map of.
template <class Map>
struct Begun {
  std::optional<Map> map;
  std::optional<CutSurface> cut;   ///< where the surface has features
  ChosenFeatures features;         ///< along which it is cut
  std::vector<int> base_vertices;  ///< of the surface, as the simplification behind `map` left them
  std::vector<OmegaRecord> omega;
  std::optional<Vec3> unplaced;  ///< where there is no map, a vertex that found no place in the last one tried
};

/// What the methods on one base complex share.
struct Start {
  Begun<Atlas> maps;          ///< for the baselines alone
  Begun<SmoothedMap> smooth;  ///< for Method::Gsp alone
};

/// Copies what is told of a smooth map, and counts how its corners moved.
void describe(const SmoothedMap& map, const std::vector<int>& base_vertices, ParameterizeResult& result) {
  result.relaxation_rounds = map.record.rounds;
  result.base_edges_flipped = map.record.edges_flipped;
  result.flips_before_repair = map.record.flips_before_repair;
  result.held_vertices = map.record.held_vertices;
  for (int b = 0; b < map.atlas.base.vertex_count(); ++b)
    result.corners_moved += map.atlas.base.vertices[b] != base_vertices[b];
}

/// Patches that are expected for so many base vertices, or for the automatic number.
double patch_count(const Mesh& mesh, int base_vertices) {
  const double count = mesh.vertex_count(),
               expected = std::min(count / kAutomaticShare, kAutomaticRoot * std::sqrt(count));
  return 2.0 * std::max(base_vertices > 0 ? base_vertices : expected, 4.0);
}

/// The surface with edges short enough for the patches, and none that joins two boundaries. `features` follow.
Mesh refined(Mesh mesh, FeatureEdges& features, const ParameterizeOptions& options, Progress& progress) {
  const auto step = progress.step("split long edges");
  const double faces = mesh.face_count();
  const int own = mesh.vertex_count();
  const auto chords = split_boundary_chords(mesh);
  if (!chords.empty())
    progress.note(std::to_string(chords.size()) + " interior edges between boundary vertices were split");
  features = split_features(features, chords, own);
  const double patches = patch_count(mesh, options.base_vertices), area = surface_area(mesh);
  const double wanted = kLongestEdge * std::sqrt(area / patches / kChartArea);
  const double most = std::min(kMostPerFace * faces, kMostPerPatch * patches);
  if (!(wanted > 0.0)) return mesh;  // no area
  const int before = mesh.vertex_count();
  const LongEdgeSplit split = split_long_edges(mesh, wanted, static_cast<int>(most));
  features = split_features(features, split.ends, before);
  if (split.added() > 0)
    progress.note(std::to_string(split.added()) + " vertices were added on edges that are long for the patches");
  if (split.longest > wanted) progress.note("edges of thin faces were left longer: patches will be long with them");
  return mesh;
}

/// A simplification of a surface in levels, the last of which starts with so many vertices.
struct Levels {
  std::shared_ptr<const Surface> surface;
  int coarsest;
  TriedBase base;
};

void note_base(const Levels& levels, const ParameterizeOptions& options, Progress& progress) {
  const Surface& surface = *levels.surface;
  const int left = surface.seams.count_whole(remaining_vertices(surface, levels.base.simplified.removals));
  if (options.base_vertices > 0 && left > options.base_vertices)
    progress.note("no further vertex can be removed: the base has " + std::to_string(left) + " vertices instead of " +
                  std::to_string(options.base_vertices));
}

Levels make_levels(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, Progress& progress) {
  const auto step = progress.step("simplify");
  const int coarsest = coarsest_level(*surface, options);
  TriedBase base = best_base(surface, options, coarsest, progress);
  Levels levels = {std::move(surface), coarsest, std::move(base)};
  note_base(levels, options, progress);
  return levels;
}

/// The simplifications of a surface cut open along its features, and of the whole, each made when first asked for.
class Simplifications {
 public:
  Simplifications(Mesh mesh, const FeatureEdges& features, const ParameterizeOptions& options, Progress& progress)
      : mesh_(std::move(mesh)), options_(options), progress_(progress) {
    if (!features.empty()) cut_ = cut_surface(mesh_, features);
  }

  /// Nothing where the surface has no features.
  const std::optional<CutSurface>& cut() const { return cut_; }
  const Levels& of_cut() {
    if (!of_cut_) of_cut_.emplace(make_levels(cut_->surface, options_, progress_));
    return *of_cut_;
  }
  const Levels& of_whole() {
    if (!of_whole_) of_whole_.emplace(make_levels(std::make_shared<const Surface>(mesh_), options_, progress_));
    return *of_whole_;
  }

 private:
  const Mesh mesh_;
  const ParameterizeOptions& options_;
  Progress& progress_;
  std::optional<CutSurface> cut_;
  std::optional<Levels> of_cut_, of_whole_;
};

/// What the last level starts with in turn, where the levels cannot be joined: a small surface is made in one, since
/// each try costs nearly as much; else larger ones, at the end as large as the surface.
std::vector<int> larger_levels(int first, int whole) {
  std::vector<int> levels;
  if (first >= whole) return levels;
  if (whole <= kOneLevel) levels.push_back(whole);
  for (long long level = 1LL * kLargerLevel * first; level < whole; level *= kLargerLevel)
    levels.push_back(static_cast<int>(level));
  if (whole > kOneLevel) levels.push_back(whole);
  return levels;
}

/// The map without folds that `make` has of the first simplification, or with a larger last level where its levels
/// cannot be joined. Nothing where none can be made; the last one may be invalid.
std::optional<SmoothedMap> join_levels(const Levels& first,
                                       const std::function<std::optional<SmoothedMap>(const SimplifyResult&)>& make,
                                       Progress& progress) {
  const int whole = first.surface->mesh.vertex_count();
  const auto why_not = [&](const std::optional<SmoothedMap>& map) -> std::optional<std::string> {
    const auto step = progress.step("check map");
    return map ? faults_of(map->atlas.finish({})) : "a vertex has no place";
  };
  std::optional<SmoothedMap> map = make(first.base.simplified), last;
  for (int coarsest : larger_levels(first.coarsest, whole)) {
    const auto why = why_not(map);
    if (!why) break;
    progress.note("the levels of the map could not be joined (" + *why + "); the last one starts with " +
                  std::to_string(coarsest) + " vertices instead");
    if (map) last = std::move(map);
    map = make(simplify(first.surface, first.base.options, coarsest, progress));
  }
  if (!map) map = std::move(last);
  if (!map) return std::nullopt;
  const int added = map->atlas.surface->mesh.vertex_count() - whole;
  if (added > 0) progress.note(std::to_string(added) + " vertices were added where the map needs more freedom");
  return map;
}

/// Sets the smooth map of one surface, cut open or whole; nothing where none could be made.
void set_map(Begun<SmoothedMap>& begun, const Levels& levels, const ParameterizeOptions& options, Progress& progress) {
  ParameterizeOptions smoothing = options;
  if (options.objective == Objective::Linear) {  // it relaxes the corners of its own solution
    smoothing.relaxations = 0;
    smoothing.base_edges = BaseEdges::Keep;
  }
  const auto make = [&](const SimplifyResult& simplified) {
    begun.base_vertices = remaining_vertices(*levels.surface, simplified.removals);
    return smooth_levels(simplified, smoothing, progress, &begun.unplaced);
  };
  begun.map = join_levels(levels, make, progress);
}

/// The same for MAPS' map, whose vertices on feature curves go to their places, so that the map can be glued.
void set_map(Begun<Atlas>& begun, const Levels& levels, const ParameterizeOptions&, Progress& progress) {
  const auto make = [&](const SimplifyResult& simplified) -> std::optional<SmoothedMap> {
    const std::optional<OverlayMap> maps = maps_overlay(simplified, &begun.unplaced);
    if (!maps) return std::nullopt;
    return SmoothedMap{maps->coarsened().atlas, {}};
  };
  const std::optional<SmoothedMap> maps = join_levels(levels, make, progress);
  if (!maps) return;
  begun.map = maps->atlas;
  if (!settle_creases(*begun.map, progress)) begun.map.reset();
}

void note_features(const ChosenFeatures& features, Progress& progress) {
  std::string note = std::to_string(features.curves) + " feature curves become base edges";
  if (features.given_way > 0)
    note += "; " + std::to_string(features.given_way) + " others, for which the base has no room, give way";
  if (features.curves + features.given_way > 0) progress.note(note);
}

/// Makes a map on the surface cut open along its features; without them where there are none, or no map of it could be
/// made. `input`: the surface before edges were split. Throws Error(InvalidMap) where there is none either.
template <class Map>
Begun<Map> begin_map(Simplifications& simplifications, const Mesh& input, const ChosenFeatures& features,
                     const ParameterizeOptions& options, Progress& progress) {
  Begun<Map> begun;
  begun.features = features;
  if (simplifications.cut()) {
    begun.cut = simplifications.cut();
    begun.omega = simplifications.of_cut().base.simplified.omega;
    set_map(begun, simplifications.of_cut(), options, progress);
    if (begun.map) return begun;
    progress.note("no map of the surface with its feature curves could be made: it is made without them");
    begun.features.given_way += std::exchange(begun.features.curves, 0);
    begun.features.edges.clear();
    begun.cut.reset();
  }
  begun.omega = simplifications.of_whole().base.simplified.omega;
  set_map(begun, simplifications.of_whole(), options, progress);
  if (!begun.map)
    refuse_map("no map of the surface could be made: a vertex found no place in it", begun.unplaced, input);
  return begun;
}

/// Simplifies the surface and makes what the methods start from, the same whichever stand beside each other.
Start make_start(const Mesh& mesh, const ChosenFeatures& chosen, const std::vector<Method>& methods,
                 const ParameterizeOptions& options, Progress& progress) {
  FeatureEdges features = chosen.edges;
  Mesh fine = refined(mesh, features, options, progress);
  Simplifications simplifications(std::move(fine), features, options, progress);
  const auto smooth_ones = std::count(methods.begin(), methods.end(), Method::Gsp);
  Start start;
  if (smooth_ones < static_cast<int>(methods.size()))
    start.maps = begin_map<Atlas>(simplifications, mesh, chosen, options, progress);
  if (smooth_ones > 0) start.smooth = begin_map<SmoothedMap>(simplifications, mesh, chosen, options, progress);
  return start;
}

/// Exact. Maps are made at one size, since solvers have thresholds of their own: a surface has the same map at any.
void scale_by_power_of_two(Mesh& mesh, int exponent) {
  for (Vec3& p : mesh.positions) p = p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
}

/// The map of one of the baselines, which all start from MAPS'.
Atlas baseline(Atlas atlas, Method method, const ParameterizeOptions& options, ParameterizeResult& result,
               Progress& progress) {
  if (method == Method::MapsSmoothed) result.flips_before_repair = smooth_by_loop(atlas, progress);
  if (method == Method::Hybrid)
    relax_patch_pairs(atlas, LinearWeights(*atlas.surface, options.weights), kPairPasses, progress);
  return atlas;
}

/// Makes the map on the surface whole again, and tells of how it began.
template <class Map>
void close_map(const Atlas& atlas, const Begun<Map>& begun, ParameterizeResult& result) {
  result.map = atlas.finish({});
  if (begun.cut) result.map = glue_map(std::move(result.map), *begun.cut);
  result.features = begun.features;
  result.omega = begun.omega;
}

/// `image`: the input in the coordinates that maps are made in.
ParameterizeResult finish(const Mesh& input, const Mesh& image, const Start& start, Method method,
                          const ParameterizeOptions& options, Progress& progress) {
  ParameterizeResult result;
  const auto step = progress.step(std::string("finish ") + method_name(method));
  if (method == Method::Gsp) {
    SmoothedMap map = *start.smooth.map;
    if (options.objective == Objective::Linear) map = linear_map(map.atlas, options, progress);
    describe(map, start.smooth.base_vertices, result);
    close_map(map.atlas, start.smooth, result);
    require_valid(result.map, image);
  } else {
    close_map(baseline(*start.maps.map, method, options, result, progress), start.maps, result);
  }
  result.map.provenance = provenance(input, options, method, result.map.base);
  return result;
}

}  // namespace

std::vector<ParameterizeResult> parameterize_all(const Mesh& mesh, const std::vector<Method>& methods,
                                                 const ParameterizeOptions& options, Progress& progress) {
  check_options(options);
  require_parameterizable(mesh);
  const Shortening shortening(mesh);
  if (shortening.any()) progress.note("the surface is long and thin, and so are its patches");
  Mesh image = mesh;
  if (shortening.any()) shortening.press(image);
  const int size = std::ilogb(bounding_box_diagonal(image));
  scale_by_power_of_two(image, -size);
  const ChosenFeatures features = choose_features(mesh, options);
  note_features(features, progress);
  const Start start = make_start(image, features, methods, options, progress);
  std::vector<ParameterizeResult> results;
  for (Method method : methods) {
    ParameterizeResult& result = results.emplace_back(finish(mesh, image, start, method, options, progress));
    scale_by_power_of_two(result.map.surface, size);
    if (!shortening.any()) continue;
    std::vector<Vec3>& positions = result.map.surface.positions;
    shortening.draw_out(result.map.surface);
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions.begin());
  }
  return results;
}

ParameterizeResult parameterize(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress) {
  return std::move(parameterize_all(mesh, {options.method}, options, progress).front());
}

double parameterize_memory(const Mesh& mesh) {
  constexpr double kProgram = 70e6, kPerFace = 0.83e3;
  return kProgram + kPerFace * static_cast<double>(mesh.face_count());
}

void write_omega_csv(const std::string& path, const std::vector<OmegaRecord>& record) {
  AtomicFile file(path);
  file.stream() << "remaining_vertices,shape,dispersion,metric,omega\n" << std::setprecision(17);
  for (const OmegaRecord& r : record)
    file.stream() << r.remaining_vertices << ',' << r.shape << ',' << r.dispersion << ',' << r.metric << ','
                  << r.omega() << '\n';
  file.commit();
}

}  // namespace gsp
