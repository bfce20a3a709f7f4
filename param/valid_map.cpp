#include "param/valid_map.h"

#include <algorithm>

#include "param/repair.h"

namespace gsp {

namespace {

constexpr int kRings = 4;
constexpr double kStride = 0.15;  // of the vertices left, from one station to the next

}  // namespace

Atlas unfolded_map(std::shared_ptr<const Surface> surface, const std::vector<Removal>& removals, Progress& progress) {
  int left = 0;
  for (int h : surface->halfedges.outgoing) left += h >= 0;
  ShrinkingMap map(surface);
  const int total = static_cast<int>(removals.size());
  for (int done = 0;;) {
    const int next = std::min(total, done + std::max(1, static_cast<int>(kStride * (left - done))));
    for (; done < next; ++done) map.remove(removals[done]);
    Atlas atlas = map.atlas();
    const RepairReport repaired = repair_folds(atlas, kRings, progress);
    if (done == total) return atlas;
    for (int v : repaired.moved) atlas.reassign(v);
    map.load(atlas, repaired.moved);
    progress.report("unfold", double(done) / total);
  }
}

}  // namespace gsp
