#include "param/energy/lower_distortion.h"

#include <algorithm>
#include <numeric>

#include "mesh/parallel.h"
#include "param/atlas/folds.h"
#include "param/energy/lower_peaks.h"
#include "param/energy/newton_descent.h"
#include "param/linear/global_system.h"

namespace gsp {

namespace {

constexpr int kMostSteps = 100;

}  // namespace

bool lower_distortion(Atlas& atlas, double least_gain, Progress& progress) {
  const auto step = progress.step("lower distortion of all at once");
  seat_boundary(atlas);
  std::vector<int> vertices, faces(atlas.surface->mesh.faces.size());
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v)
    if (atlas.is_free(v)) vertices.push_back(v);
  if (vertices.empty()) return false;
  std::iota(faces.begin(), faces.end(), 0);
  const DistortionEnergy energy(atlas, vertices, faces, reference_shapes(atlas, faces), kMapAreaWeight);
  std::vector<double> x = energy.positions(atlas);
  const std::vector<Complex> before = atlas.position;
  lower_peaks(energy, x);
  NewtonDescent descent(energy, x);
  for (int i = 0; i < kMostSteps; ++i) {
    progress.report("lower distortion", double(i) / kMostSteps);
    if (descent.step() < least_gain) break;
  }
  energy.write_back(x, atlas);
  if (!find_folds(atlas).none()) {
    atlas.position = before;
    return false;
  }
  atlas.reassign_all();
  return true;
}

namespace {

constexpr int kBlock = 2000;  // vertices
constexpr int kOverlap = 3;   // rings around a block that are solved with it
constexpr int kBlockSteps = 12;
constexpr double kBlockGain = 1e-3;  // share of a block's energy

/// The free vertices in connected blocks, each in the order in which it grew.
std::vector<std::vector<int>> blocks_of(const Atlas& atlas) {
  std::vector<std::vector<int>> blocks;
  std::vector<char> taken(atlas.patch.size(), 0);
  std::vector<int> seeds;  // met while others grew, so that blocks lie beside each other
  std::size_t next_seed = 0;
  const auto grow = [&](int seed) {
    std::vector<int> block{seed};
    taken[seed] = 1;
    for (std::size_t i = 0; i < block.size(); ++i)
      atlas.surface->for_each_neighbour(block[i], [&](int w, int, bool) {
        if (taken[w] || !atlas.is_free(w)) return;
        if (block.size() >= kBlock) {
          seeds.push_back(w);
          return;
        }
        taken[w] = 1;
        block.push_back(w);
      });
    blocks.push_back(std::move(block));
  };
  for (int v = 0; v < static_cast<int>(taken.size()); ++v) {
    if (!taken[v] && atlas.is_free(v)) grow(v);
    for (; next_seed < seeds.size(); ++next_seed)
      if (!taken[seeds[next_seed]]) grow(seeds[next_seed]);
  }
  return blocks;
}

/// One block with the rings around it, whose energy is lowered with everything else held.
struct Block {
  std::vector<int> vertices, faces;
};

std::vector<Block> overlapping_blocks(const Atlas& atlas) {
  const Surface& surface = *atlas.surface;
  std::vector<Block> blocks;
  std::vector<int> reached(atlas.patch.size(), -1);
  for (std::vector<int>& grown : blocks_of(atlas)) {
    const int number = static_cast<int>(blocks.size());
    Block block{std::move(grown), {}};
    for (int v : block.vertices) reached[v] = number;
    std::size_t ring = 0;
    for (int i = 0; i < kOverlap; ++i)
      for (const std::size_t end = block.vertices.size(); ring < end; ++ring)
        surface.for_each_neighbour(block.vertices[ring], [&](int w, int, bool) {
          if (reached[w] == number || !atlas.is_free(w)) return;
          reached[w] = number;
          block.vertices.push_back(w);
        });
    std::sort(block.vertices.begin(), block.vertices.end());
    block.faces = faces_around(surface, block.vertices);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Blocks in groups, within which no two share a face, so that they can be solved side by side.
std::vector<std::vector<int>> independent_groups(const std::vector<Block>& blocks, std::size_t faces) {
  std::vector<std::vector<int>> at_face(faces);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int f : blocks[b].faces) at_face[f].push_back(static_cast<int>(b));
  std::vector<int> group(blocks.size(), -1);
  std::vector<std::vector<int>> groups;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::vector<char> used(groups.size() + 1, 0);
    for (int f : blocks[b].faces)
      for (int other : at_face[f])
        if (group[other] >= 0) used[group[other]] = 1;
    group[b] = static_cast<int>(std::find(used.begin(), used.end(), 0) - used.begin());
    if (group[b] == static_cast<int>(groups.size())) groups.emplace_back();
    groups[group[b]].push_back(static_cast<int>(b));
  }
  return groups;
}

}  // namespace

void lower_distortion_locally(Atlas& atlas, int sweeps, Progress& progress) {
  const auto step = progress.step("lower distortion block by block");
  seat_boundary(atlas);
  std::vector<int> faces(atlas.surface->mesh.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  const std::vector<ReferenceShape> shapes = reference_shapes(atlas, faces);
  const std::vector<Block> blocks = overlapping_blocks(atlas);
  const auto groups = independent_groups(blocks, faces.size());
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t g = 0; g < groups.size(); ++g) {
      progress.report("lower distortion", (sweep + double(g) / groups.size()) / sweeps);
      parallel_for(groups[g].size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Block& block = blocks[groups[g][i]];
          std::vector<ReferenceShape> own;
          for (int f : block.faces) own.push_back(shapes[f]);
          const DistortionEnergy energy(atlas, block.vertices, block.faces, own, kMapAreaWeight);
          std::vector<double> x = energy.positions(atlas);
          lower_peaks(energy, x);
          NewtonDescent descent(energy, x);
          for (int step = 0; step < kBlockSteps; ++step)
            if (descent.step() < kBlockGain) break;
          energy.write_back(x, atlas);
        }
      });
    }
  atlas.reassign_all();
}

}  // namespace gsp
