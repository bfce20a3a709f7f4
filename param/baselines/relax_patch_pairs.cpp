#include "param/baselines/relax_patch_pairs.h"

#include "param/atlas/folds.h"
#include "param/linear/global_system.h"

namespace gsp {

namespace {

constexpr int kTries = 4;  // solutions of a pair, each with more vertices held

/// Takes the corners of folded faces at some vertices, and their neighbours, out of `solved`. Returns whether any face
/// was folded.
bool hold_folded(const Atlas& atlas, const std::vector<int>& faces, std::vector<char>& solved) {
  bool any = false;
  for (int f : faces) {
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    if (upright(z[0], z[1], z[2])) continue;
    any = true;
    for (int v : atlas.surface->mesh.faces[f]) {
      solved[v] = 0;
      atlas.surface->for_each_neighbour(v, [&](int neighbour, int, bool) { solved[neighbour] = 0; });
    }
  }
  return any;
}

/// Relaxes the free vertices in two patches together.
void relax_pair(Atlas& atlas, const LinearWeights& weights, int first, int second) {
  std::vector<int> vertices;
  std::vector<char> solved(atlas.patch.size());
  for (int v = 0; v < static_cast<int>(solved.size()); ++v) {
    solved[v] = (atlas.patch[v] == first || atlas.patch[v] == second) && atlas.is_free(v);
    if (solved[v]) vertices.push_back(v);
  }
  const std::vector<int> faces = faces_around(*atlas.surface, vertices);
  const std::vector<Complex> before = atlas.position;
  for (int attempt = 0;; ++attempt) {
    atlas.position = solve_global(atlas, weights, solved);
    if (!hold_folded(atlas, faces, solved)) break;
    atlas.position = before;
    if (attempt == kTries) return;
  }
  for (int v : vertices) atlas.reassign(v);
}

}  // namespace

void relax_patch_pairs(Atlas& atlas, const LinearWeights& weights, int passes, Progress& progress) {
  seat_boundary(atlas);
  const std::vector<Complex> straight = atlas.position;
  atlas.position = boundary_by_arc_length(atlas);
  if (!find_folds(atlas).none()) atlas.position = straight;
  const int sides = static_cast<int>(atlas.base.twins.size());
  for (int pass = 0; pass < passes; ++pass)
    for (int h = 0; h < sides; ++h) {
      const int twin = atlas.base.twins[h];
      if (twin < h) continue;
      progress.report("relax pairs of patches", (pass + double(h) / sides) / passes);
      relax_pair(atlas, weights, h / 3, twin / 3);
    }
  atlas.reassign_all();
}

}  // namespace gsp
