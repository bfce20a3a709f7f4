#pragma once

#include <string>
#include <vector>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

/// What the vertices of a remesh are.
enum class Positions {
  Sampled,  ///< the surface's points at the dyadic points of the domain, as in the paper
  Fitted,   ///< where the faces are near the surface while the vertices keep, among each other, the map's places:
            ///< projected on the map's inverse (fit_positions.h), then moved towards the closest points
            ///< (closest_fit.h). Nearer at equal bytes
  Closest,  ///< the same with little to hold the vertices: nearest, but the vertices' places along the surface cost
            ///< bytes
};
inline constexpr Positions kPositions[] = {Positions::Fitted, Positions::Sampled, Positions::Closest};
/// fitted, sampled, closest.
const char* positions_name(Positions positions);
/// The inverse. Throws Error(BadOption).
Positions positions_of(const std::string& word);

/// How the vertices above the base are given, and so what a code of them is made of.
enum class RemeshKind {
  Parametric,         ///< three numbers a vertex: where the map has it (paper §4)
  Normal,             ///< one, but for marked exceptions: along the normal of what the coarser level predicts (Guskov,
                      ///< Vidimče, Sweldens, Schröder 2000)
  VariationalNormal,  ///< the same with fewer exceptions, at a small error in place of them, which fitted positions
                      ///< take back (after Friedel, Schröder, Khodakovsky 2004)
  Displaced,          ///< one: along the normals of a smooth control surface (Lee, Moreton, Hoppe 2000)
};
inline constexpr RemeshKind kRemeshKinds[] = {RemeshKind::Parametric, RemeshKind::Normal, RemeshKind::VariationalNormal,
                                              RemeshKind::Displaced};
/// parametric, normal, variational-normal, displaced.
const char* remesh_kind_name(RemeshKind kind);
/// The inverse. Throws Error(BadOption).
RemeshKind remesh_kind_of(const std::string& word);

/// What the details of normal kinds are added to.
enum class Prediction {
  Butterfly,        ///< modified Butterfly, which keeps the coarser level's vertices
  ButterflyLifted,  ///< the details of lifted Butterfly, which codes better; with fitted positions
  Loop,             ///< Loop's new vertices (the paper's "Normal Loop"); with sampled positions
};
inline constexpr Prediction kPredictions[] = {Prediction::Butterfly, Prediction::ButterflyLifted, Prediction::Loop};
/// butterfly, butterfly-lifted, loop.
const char* prediction_name(Prediction prediction);
/// The inverse. Throws Error(BadOption).
Prediction prediction_of(const std::string& word);

struct RemeshOptions {
  /// Quadrisections of the base, 0..kMaxSubdivisionLevel, or kAutoLevel: the first level with at least as many faces as
  /// the surface, and 32,768, or the deepest one. Fewer are worth it only where the remesh itself is to be small: long
  /// flat faces and creases of a coarse surface want vertices that the coder hardly pays for.
  int level = kAutoLevel;
  static constexpr int kAutoLevel = 99;
  Positions positions = Positions::Fitted;
  /// Rounds in which fitted positions move towards the closest points, at most. 1 for a quick look: the remesh is then
  /// some tenths of a dB farther from the surface.
  int most_fit_rounds = 100;
  RemeshKind kind = RemeshKind::Parametric;
  /// Of normal kinds; others do without. A code keeps its details normal with the wavelet of the same name.
  Prediction predict = Prediction::Butterfly;
  /// Of kind variational-normal: how far off the surface a vertex may be, over the diagonal, 0..1, so as not to be an
  /// exception of three numbers.
  double normal_tolerance = 1e-4;
};

/// What a remesh's file says of how its vertices were made, for `write_semiregular`: "kind parametric", "positions
/// fitted"; of normal kinds "predict butterfly".
std::vector<std::string> provenance_of(const RemeshOptions& options);

}  // namespace gsp
