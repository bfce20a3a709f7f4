#include "param/baselines/relax_patch_pairs.h"

#include "param/linear/global_system.h"

namespace gsp {

void relax_patch_pairs(Atlas& atlas, const LinearWeights& weights, int passes, Progress& progress) {
  seat_boundary(atlas);
  atlas.position = boundary_by_arc_length(atlas);
  const int sides = static_cast<int>(atlas.base.twins.size());
  std::vector<char> solved(atlas.patch.size());
  for (int pass = 0; pass < passes; ++pass)
    for (int h = 0; h < sides; ++h) {
      const int twin = atlas.base.twins[h];
      if (twin < h) continue;
      progress.report("relax pairs of patches", (pass + double(h) / sides) / passes);
      for (std::size_t v = 0; v < solved.size(); ++v)
        solved[v] = (atlas.patch[v] == h / 3 || atlas.patch[v] == twin / 3) && atlas.is_free(static_cast<int>(v));
      atlas.position = solve_global(atlas, weights, solved);
      for (std::size_t v = 0; v < solved.size(); ++v)
        if (solved[v]) atlas.reassign(static_cast<int>(v));
    }
  atlas.reassign_all();
}

}  // namespace gsp
