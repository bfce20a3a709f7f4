#include "experiments/figures/sector_disc.h"

#include "coder/wavelet_transform.h"
#include "experiments/figures/remesh_map.h"
#include "mesh/shapes.h"
#include "param/linear/global_system.h"

namespace gsp {

namespace {

SemiregularMesh unrefined(int sectors) {
  const Mesh disc = shapes::sector_disc(sectors, 0);
  return {.level = 0, .base_vertices = disc.vertex_count(), .base_faces = disc.faces, .positions = disc.positions};
}

}  // namespace

Parameterization relaxed_sector_disc(int sectors, int level) {
  Atlas atlas = atlas_of(remesh_as_map(at_level(unrefined(sectors), level)));
  atlas.position = solve_global(atlas, LinearWeights(*atlas.surface, Weights::MeanValue), interior_vertices(atlas));
  atlas.reassign_all();
  return atlas.finish({});
}

Parameterization loop_sector_disc(int sectors, int level) {
  SemiregularMesh disc = unrefined(sectors);
  const WaveletTransform loop(subdivision_levels(disc.base_vertices, disc.base_faces, level - 1), Wavelet::Loop);
  for (int l = 0; l < level; ++l) {
    const std::size_t coarse = disc.positions.size();
    const std::size_t fine = subdivision_levels(disc.base_vertices, disc.base_faces, l + 1).back().vertex_count;
    disc.positions = loop.synthesis(l, disc.positions, std::vector<Vec3>(fine - coarse, Vec3::Zero()));
  }
  disc.level = level;
  return remesh_as_map(disc);
}

}  // namespace gsp
