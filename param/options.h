#pragma once

#include <optional>
#include <string>

#include "mesh/export.h"
#include "mesh/features/features.h"

namespace GSP_PUBLIC gsp {

/// How the map over the base complex is made.
enum class Method {
  Gsp,           ///< the paper: global system with transitions, corner relaxation (§3.2)
  Maps,          ///< the initial map of the simplification, as MAPS leaves it (Lee et al. 1998)
  MapsSmoothed,  ///< the same, smoothed by Loop subdivision on the parameters (the paper's figure 1a)
  Hybrid         ///< the same, each pair of adjacent patches relaxed with its boundary held, several times (figure 1c)
};
inline constexpr Method kMethods[] = {Method::Gsp, Method::Maps, Method::MapsSmoothed, Method::Hybrid};

/// "gsp", "maps", "maps-smoothed", "hybrid".
const char* method_name(Method method);
/// The inverse. Throws Error(BadOption).
Method method_of(const std::string& word);

/// What the smooth map of Method::Gsp minimises.
enum class Objective {
  Distortion,  ///< `DistortionEnergy` over maps without folds: near-isometric, measured better in remeshing error and
               ///< rate
  Linear       ///< the paper's global linear system (§3.2.1), repaired where it folds
};
inline constexpr Objective kObjectives[] = {Objective::Distortion, Objective::Linear};

/// "distortion", "linear".
const char* objective_name(Objective objective);
/// The inverse. Throws Error(BadOption).
Objective objective_of(const std::string& word);

/// Of the linear systems: the global one of Objective::Linear, and those on the discs of the corner relaxation.
enum class Weights {
  MeanValue,  ///< the paper's (Floater 2003): positive, not symmetric
  Cotangent,  ///< on the intrinsic Delaunay triangulation: the map of least Dirichlet energy
  Uniform     ///< 1: knows the connectivity alone
};
inline constexpr Weights kWeights[] = {Weights::MeanValue, Weights::Cotangent, Weights::Uniform};

/// "mean-value", "cotangent", "uniform".
const char* weights_name(Weights weights);
/// The inverse. Throws Error(BadOption).
Weights weights_of(const std::string& word);

/// How the patch corners find their places.
enum class Corners {
  Relax,    ///< the paper's relaxation on discs (§3.2.2)
  Gradient  ///< down the gradient of what the map minimises, from vertex to vertex
};
inline constexpr Corners kCorners[] = {Corners::Relax, Corners::Gradient};

/// "relax", "gradient".
const char* corners_name(Corners corners);
/// The inverse. Throws Error(BadOption).
Corners corners_of(const std::string& word);

/// Whether the base keeps the edges that the simplification left.
enum class BaseEdges {
  Flip,  ///< where that lowers the distortion; with Objective::Distortion alone
  Keep   ///< the paper's
};
inline constexpr BaseEdges kBaseEdges[] = {BaseEdges::Flip, BaseEdges::Keep};

/// "flip", "keep".
const char* base_edges_name(BaseEdges base_edges);
/// The inverse. Throws Error(BadOption).
BaseEdges base_edges_of(const std::string& word);

/// In which order the simplification removes vertices.
enum class Priority {
  Omega,  ///< the paper's: least Ω first (§3.1.1)
  Maps    ///< MAPS' own (Lee et al. 1998): independent sets, by area and curvature
};
inline constexpr Priority kPriorities[] = {Priority::Omega, Priority::Maps};

/// "omega", "maps".
const char* priority_name(Priority priority);
/// The inverse. Throws Error(BadOption).
Priority priority_of(const std::string& word);

/// Sizes of the base that are no number: where the paper's simplification stops before metric distortion dominates Ω
/// (§3.1.1, figure 5d), and the one that costs the fewest bytes, which `parameterize` does not know
/// (experiments/base/base_by_rate.h).
inline constexpr int kBaseByOmega = 0, kBaseByRate = -1;

/// Ways to find feature curves that are no angle: none, and those of `detect_features`.
inline constexpr int kNoFeatures = 0, kAutoFeatures = -1;

struct ParameterizeOptions {
  Method method = Method::Gsp;
  Objective objective = Objective::Distortion;
  Weights weights = Weights::MeanValue;
  Corners corners = Corners::Relax;
  BaseEdges base_edges = BaseEdges::Flip;
  /// Change it to stand on a base as MAPS made it. Holes are filled by least Ω either way. Its size must be given:
  /// `kBaseByOmega` is about the order of Ω.
  Priority priority = Priority::Omega;
  /// Curves of sharp edges that become chains of base edges: found by `detect_features`, none, or all edges at or over
  /// a dihedral angle in 1 to 179 degrees. None for the paper's map, which runs across sharp edges.
  int feature_degrees = kAutoFeatures;
  std::optional<FeatureEdges> features = {};  ///< these instead; interior edges of the surface
  /// Base vertices to stop at, at least 4, or `kBaseByOmega`. The simplification stops earlier, with a note, where no
  /// vertex can be removed any more.
  int base_vertices = kBaseByOmega;
  double gamma = 2.0;  ///< weight of triangle shape in Ω, >= 0
  double mu = 1.0;     ///< weight of area dispersion in Ω, >= 0
  /// Which repetition of the experiment this is, >= 0. 0 is the surface as it is; each other number moves the prices of
  /// vertex removals by a factor of its own, at most 1e-4 from 1, and so decides otherwise where chance decides. Change
  /// it to learn how much of a result is chance.
  int replicate = 0;
  /// Bases to try, 1 to kMostTries, of which the one is kept whose coarsest level has the least distortion once it is
  /// smooth (param/stages/try_bases.h). More than 1 for a little less distortion at that many times the simplification.
  int tries = 1;
  static constexpr int kMostTries = 64;
  int relaxations = 4;  ///< at most so many corner relaxations between solves, >= 0; it ends when no corner moves
};

/// Options of the paper's exact method: its linear system with mean value weights and its corner relaxation (§3.2),
/// besides the repair of folds, since an invalid map is no result.
ParameterizeOptions paper_options();

/// One vertex removal: the three area-weighted parts of Ω, for figure 5d.
struct OmegaRecord {
  int remaining_vertices = 0;
  double shape = 0.0;       ///< Σ A γ (σ-1)²
  double dispersion = 0.0;  ///< Σ A μ (ρ-1)²
  double metric = 0.0;      ///< Σ A (δ-1)²
  double omega() const { return shape + dispersion + metric; }
};

}  // namespace gsp
