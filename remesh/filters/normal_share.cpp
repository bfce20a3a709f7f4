#include "remesh/filters/normal_share.h"

#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/local_frames.h"

namespace gsp {

NormalShare normal_share(const SemiregularMesh& mesh) {
  constexpr double kRounding = 1e-9;
  double extent = 0.0;
  for (const Vec3& p : mesh.positions) extent = std::max(extent, (p - mesh.positions[0]).cwiseAbs().maxCoeff());
  NormalShare share;
  SubdivisionLevel level = base_level(mesh.base_vertices, mesh.base_faces, mesh.creases, mesh.corners);
  for (int l = 0; l < mesh.level; ++l) {
    const std::vector<Vec3> coarse(mesh.positions.begin(), mesh.positions.begin() + level.vertex_count);
    std::vector<Vec3> predicted(level.vertex_count + level.edges.size(), Vec3::Zero());
    butterfly_low_pass(level)->add(coarse.data(), predicted.data());
    const EdgeFrames frames(level, coarse);
    for (int e = 0; e < level.edge_count(); ++e) {
      ++share.vertices;
      if (level.sharp(e)) {
        ++(level.on_boundary(e) ? share.boundary : share.creased);
        continue;
      }
      const int vertex = level.vertex_count + e;
      const Vec3 detail = frames(e).transpose() * (mesh.positions[vertex] - predicted[vertex]);
      ++(detail.tail<2>().norm() <= kRounding * extent ? share.normal : share.exceptions);
    }
    if (l + 1 < mesh.level) level = subdivide(level);
  }
  return share;
}

}  // namespace gsp
