#pragma once

#include <vector>

#include "remesh/displaced/fit_target.h"
#include "remesh/vertex_system.h"

namespace gsp {

/// The squared distances of edges' midpoints from a target, each weighed by the area beside its edge over that on the
/// smooth surface. A remesh breaks where neighbours go to different sheets: its vertices are on the surface, the long
/// faces between them are not, and only their midpoints say so.
class EdgeWatch {
 public:
  /// `edges` of the level; `surface`, its vertices' points on the smooth surface. All but those two are kept by
  /// reference.
  EdgeWatch(const SubdivisionLevel& level, const std::vector<Vec3>& surface, const FitTarget& target,
            const std::vector<int>& edges);

  /// Moves the midpoints' places, from where they were, to the nearest ones with the vertices at `positions`, #V,
  /// which the other two then take.
  void find_places(const std::vector<Vec3>& positions);
  double energy() const;
  /// Adds the residuals along the target's normals.
  void add_to(VertexSystem& system) const;

 private:
  struct Watched {
    int edge;
    double rest;  ///< area beside it on the smooth surface
    LevelPlace place;
    Vec3 middle = Vec3::Zero();
    double weight = 0.0, squared = 0.0;
  };
  double area_beside(int edge, const std::vector<Vec3>& positions) const;

  const SubdivisionLevel& level_;
  const FitTarget& target_;
  std::vector<Watched> watched_;
};

}  // namespace gsp
