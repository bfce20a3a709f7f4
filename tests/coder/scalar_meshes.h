#pragma once

#include "coder/wavelet_transform.h"
#include "remesh/filters/local_frames.h"
#include "tests/coder/sample_meshes.h"

namespace gsp::samples {

/// A mesh whose details have a normal component only, but for those of boundary edges: random ones, `size` large on the
/// base's edges and a quarter as large on each further level.
inline SemiregularMesh scalar(const Mesh& base, int level, double size, Wavelet wavelet = Wavelet::Butterfly) {
  Random random(3);
  SemiregularMesh mesh{level, base.vertex_count(), base.faces, base.positions};
  const WaveletTransform transform(subdivision_levels(mesh.base_vertices, mesh.base_faces, level - 1), wavelet);
  for (int l = 0; l < level; ++l) {
    const SubdivisionLevel& edges = transform.levels()[l];
    const EdgeFrames frames(edges, mesh.positions);
    std::vector<Vec3> details;
    for (int e = 0; e < edges.edge_count(); ++e) {
      const Vec3 local(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
      const double scale = std::ldexp(size, -2 * l);
      const bool boundary = edges.edge_faces[e][1] < 0;
      details.push_back(boundary ? Vec3(scale * local) : Vec3(scale * local.x() * frames(e).col(0)));
    }
    mesh.positions = transform.synthesis(l, std::move(mesh.positions), details);
  }
  return mesh;
}

}  // namespace gsp::samples
