#include "param/corners/relax_corners.h"

#include <algorithm>

#include "mesh/parallel.h"
#include "param/corners/corner_move.h"

namespace gsp {

namespace {

constexpr double kShrink[] = {1.0, 0.6, 0.36};  // of the radius, where a larger region would fold

/// Lays the whole region out from the disc, with the vertex nearest 0 drawn onto it. Where that would leave a fold,
/// only moves the corner. False where the region is no disc or nothing would change for the better.
bool relax(CornerDisc disc, const LinearWeights& weights, CornerMove& move) {
  if (!disc.collect() || !disc.solve(weights) || !disc.embedded()) return false;
  const int nearest = disc.fan().boundary ? 0 : disc.nearest_to(0.0);
  CornerDisc drawn = disc;
  if (drawn.draw_to_center(nearest) && drawn.embedded() && drawn.upright_in_plane(nearest))
    return make_move(drawn, nearest, move);
  return nearest != 0 && make_move(disc, nearest, move);
}

}  // namespace

int move_corners(Atlas& atlas, double radius, Folding folding, const MakeCornerMove& make) {
  int moved = 0;
  std::vector<char> done(atlas.fans.size(), 0);
  std::vector<char> inside(atlas.surface->mesh.positions.size(), 0), rim(inside);
  for (double shrink : kShrink) {
    std::vector<CornerMove> moves(atlas.fans.size());
    parallel_for(moves.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        if (!done[b] && atlas.surface->seams.point_of(atlas.base.vertices[b]) < 0 &&
            make(CornerDisc(atlas, shrink * radius, static_cast<int>(b)), moves[b]))
          moves[b].base_vertex = static_cast<int>(b);
    });
    for (CornerMove& move : moves) {
      if (move.base_vertex < 0) continue;
      // Where edges are long two regions can overlap: the later corner waits for the next round.
      const bool overlap = std::any_of(move.rim.begin(), move.rim.end(), [&](int v) { return inside[v]; }) ||
                           std::any_of(move.places.begin(), move.places.end(), [&](const CornerMove::Place& place) {
                             return inside[place.vertex] || rim[place.vertex];
                           });
      if (overlap) continue;
      exchange(atlas, move);
      if (folding == Folding::Refused && !free_of_folds(atlas, move)) {
        exchange(atlas, move);
        continue;
      }
      for (int v : move.rim) rim[v] = 1;
      for (const CornerMove::Place& place : move.places) inside[place.vertex] = 1;
      done[move.base_vertex] = 1;
      ++moved;
    }
  }
  return moved;
}

int relax_corners(Atlas& atlas, const LinearWeights& weights, double radius, Folding folding) {
  return move_corners(atlas, radius, folding,
                      [&](CornerDisc disc, CornerMove& move) { return relax(std::move(disc), weights, move); });
}

}  // namespace gsp
