#pragma once

#include <vector>

#include "param/corners/corner_disc.h"

namespace gsp {

/// What laying the region around a corner out from its disc changes in the atlas.
struct CornerMove {
  struct Place {
    int vertex;
    int chart;
    Complex position;
  };
  struct Change {
    int edge;
    Transition transition;
  };
  int base_vertex = -1;
  int new_corner = -1;
  std::vector<Place> places;        ///< of the inside
  std::vector<Change> transitions;  ///< of all edges at it
  std::vector<int> rim;
};

/// The move that takes the disc back to the charts by z^(k/6), with the vertex of index `center`, which lies at 0, as
/// the corner. False where its transitions would not compose to the identity around every face.
bool make_move(const CornerDisc& disc, int center, CornerMove& move);

/// Makes the move; a second call with the same values takes it back.
void exchange(Atlas& atlas, CornerMove& move);

/// Whether no face that the move touches is folded, and none of its vertices wound wrongly.
bool free_of_folds(const Atlas& atlas, const CornerMove& move);

}  // namespace gsp
