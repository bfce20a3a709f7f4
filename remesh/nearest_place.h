#pragma once

#include <array>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

/// A point of a level's surface: in a face, at the weights of its corners, which are not negative and sum to 1.
struct LevelPlace {
  int face = 0;
  std::array<double, 3> weights = {1.0, 0.0, 0.0};

  /// Where that is with the vertices at `positions`, #V.
  Vec3 at(const SubdivisionLevel& level, const std::vector<Vec3>& positions) const {
    const Triangle& t = level.faces[face];
    return weights[0] * positions[t[0]] + weights[1] * positions[t[1]] + weights[2] * positions[t[2]];
  }
  bool inside_face() const { return weights[0] > 0.0 && weights[1] > 0.0 && weights[2] > 0.0; }
};

/// Walks from `place` to neighbouring faces as long as one is nearer to `point`, over the surface and never across to
/// another sheet or a crease; returns the squared distance. Where the surface bends less than the distance to it that
/// place is the nearest one. At an edge the face across is tried, at a vertex all around it, from the start on: where a
/// place between faces ends does not depend on which of them it is given in. A face without area acts as its edges.
double walk_to_nearest(const SubdivisionLevel& level, const std::vector<Vec3>& positions, const Vec3& point,
                       LevelPlace& place);

}  // namespace gsp
