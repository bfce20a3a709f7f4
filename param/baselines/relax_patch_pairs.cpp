#include "param/baselines/relax_patch_pairs.h"

#include <algorithm>
#include <utility>

#include "param/atlas/folds.h"
#include "param/linear/global_system.h"

namespace gsp {

namespace {

constexpr int kTries = 4;  // solutions of a pair, each with more vertices held

/// Relaxes pairs of patches, each in time that does not grow with the rest of the surface.
class PairRelaxation {
 public:
  PairRelaxation(Atlas& atlas, const LinearWeights& weights)
      : atlas_(atlas), weights_(weights), by_patch_(atlas.base.face_count()), held_(atlas.patch.size(), 0) {
    for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v)
      if (atlas.is_free(v)) by_patch_[atlas.patch[v]].push_back(v);
  }

  /// The free vertices in the two patches together.
  void relax(int first, int second) {
    std::vector<int> vertices = std::exchange(by_patch_[first], {});
    const std::vector<int> others = std::exchange(by_patch_[second], {});
    vertices.insert(vertices.end(), others.begin(), others.end());
    std::sort(vertices.begin(), vertices.end());
    move(vertices);
    for (int v : vertices) by_patch_[atlas_.patch[v]].push_back(v);
  }

 private:
  void move(const std::vector<int>& vertices) {
    const std::vector<int> faces = faces_around(*atlas_.surface, vertices);
    std::vector<int> solved = vertices, held;
    for (int attempt = 0; attempt <= kTries; ++attempt) {
      const std::vector<Complex> solution = solve_vertices(atlas_, weights_, solved);
      std::vector<Complex> before;
      for (std::size_t i = 0; i < solved.size(); ++i)
        before.push_back(std::exchange(atlas_.position[solved[i]], solution[i]));
      const bool folded = hold_folded(faces, held);
      if (!folded) {
        for (int v : vertices) atlas_.reassign(v);
        break;
      }
      for (std::size_t i = 0; i < solved.size(); ++i) atlas_.position[solved[i]] = before[i];
      std::erase_if(solved, [&](int v) { return held_[v] != 0; });
    }
    for (int v : held) held_[v] = 0;
  }

  /// Holds the corners of folded faces, and their neighbours, from now on. Returns whether any face was folded.
  bool hold_folded(const std::vector<int>& faces, std::vector<int>& held) {
    bool any = false;
    const auto hold = [&](int v) {
      if (!std::exchange(held_[v], 1)) held.push_back(v);
    };
    for (int f : faces) {
      const auto z = atlas_.face_corners(f, atlas_.face_frame(f));
      if (upright(z[0], z[1], z[2])) continue;
      any = true;
      for (int v : atlas_.surface->mesh.faces[f]) {
        hold(v);
        atlas_.surface->for_each_neighbour(v, [&](int neighbour, int, bool) { hold(neighbour); });
      }
    }
    return any;
  }

  Atlas& atlas_;
  const LinearWeights& weights_;
  std::vector<std::vector<int>> by_patch_;  ///< the free vertices of each
  std::vector<char> held_;                  ///< #V, of the pair in hand
};

}  // namespace

void relax_patch_pairs(Atlas& atlas, const LinearWeights& weights, int passes, Progress& progress) {
  seat_boundary(atlas);
  const std::vector<Complex> straight = atlas.position;
  atlas.position = boundary_by_arc_length(atlas);
  if (!find_folds(atlas).none()) atlas.position = straight;
  PairRelaxation pairs(atlas, weights);
  const int sides = static_cast<int>(atlas.base.twins.size());
  for (int pass = 0; pass < passes; ++pass)
    for (int h = 0; h < sides; ++h) {
      const int twin = atlas.base.twins[h];
      if (twin < h) continue;
      progress.report("relax pairs of patches", (pass + double(h) / sides) / passes);
      pairs.relax(h / 3, twin / 3);
    }
  atlas.reassign_all();
}

}  // namespace gsp
