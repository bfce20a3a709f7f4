#include "param/map/base_complex.h"

#include <algorithm>
#include <cassert>

#include "mesh/edge.h"
#include "mesh/halfedges.h"

namespace gsp {

void BaseComplex::connect() {
  Mesh topology;
  topology.positions.resize(vertices.size());
  topology.faces = faces;
  twins = Halfedges(topology).twin;
}

Transition BaseComplex::across(int h) const {
  assert(twins[h] >= 0);
  // The edge runs from corner k to k+1 here and from corner m to m+1 there, the other way round:
  // corner k must land on corner m+1 and corner k+1 on corner m.
  static constexpr int direction[3] = {0, 2, 4};  // corner k to k+1 is ω^(2k)
  const int k = h % 3, m = twins[h] % 3;
  Transition t;
  t.rotation = (direction[m] + 3 - direction[k] + 6) % 6;
  t.translation = kChartCorners[(m + 1) % 3] - rotate(kChartCorners[k], t.rotation);
  return t;
}

std::vector<char> BaseComplex::crease_halfedges() const {
  std::vector<char> on_crease(twins.size(), 0);
  for (std::size_t h = 0; h < twins.size() && !creases.empty(); ++h) {
    const int a = faces[h / 3][h % 3], b = faces[h / 3][(h + 1) % 3];
    on_crease[h] = std::binary_search(creases.begin(), creases.end(), ascending(a, b));
  }
  return on_crease;
}

}  // namespace gsp
