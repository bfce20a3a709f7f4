#pragma once

#include <string>
#include <vector>

#include "mesh/progress.h"
#include "param/map/parameterization.h"
#include "remesh/semiregular.h"

namespace gsp {

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

struct RemeshOptions {
  /// Quadrisections of the base, 0..kMaxSubdivisionLevel, or kAutoLevel: the first level with at least as many faces as
  /// the surface, or the deepest one.
  int level = kAutoLevel;
  static constexpr int kAutoLevel = 99;
  Positions positions = Positions::Fitted;
};

/// Quadrisects the base and maps every dyadic point through the parameterization to the surface (paper §4); fitted
/// positions are then moved to where the faces between them, instead of the points, are nearest to the surface.
/// Sampled points on base vertices are the surface's own vertices, bit for bit. For a map that `check_map` finds valid
/// every sample is the exact inverse. Where a baseline's map folds, faces of positive area are preferred to flipped
/// ones; a point in no face takes the nearest place in a face beside it, and `progress` notes how many there were.
/// O(faces + samples), of which a fit takes 16 a vertex or more, on all threads but for the fit's solutions, the same
/// bits for any number of them. Throws Error: BadOption, InvalidMap where nothing covers a base face, the errors of
/// `require_well_formed`.
SemiregularMesh remesh(const Parameterization& map, const RemeshOptions& options, Progress& progress);

/// What a remesh's file says of how its vertices were made, for `write_semiregular`: "positions fitted".
std::vector<std::string> provenance_of(const RemeshOptions& options);

}  // namespace gsp
