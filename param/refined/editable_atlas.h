#pragma once

#include <vector>

#include "param/atlas/atlas.h"
#include "param/refined/refined_surface.h"

namespace gsp {

/// A map without folds of a refined surface.
struct EditableAtlas {
  RefinedSurface refined;
  Atlas atlas;                ///< of the compact form of `refined`
  std::vector<int> vertex;    ///< per vertex of `refined`, its number in the atlas, -1 for those that are out
  std::vector<int> halfedge;  ///< per half-edge of the atlas's surface, its number in `refined`
};

/// What an `Atlas` holds, by the vertices and half-edges of a surface whose triangles come and go.
struct LooseMap {
  std::vector<int> patch;              ///< per vertex, -1 for those that are out
  std::vector<int> corner;             ///< per vertex, its base vertex or -1
  std::vector<Complex> position;       ///< per vertex
  std::vector<Transition> transition;  ///< per half-edge, from the chart of its head to that of its tail

  /// Where the two other corners of the face of h lie in the chart of the vertex that it leaves.
  std::pair<Complex, Complex> link(const TriangleLinks& links, int h) const {
    const int back = Halfedges::prev(h);
    return {transition[h].apply(position[links.to(h)]), transition[back].inverse().apply(position[links.from(back)])};
  }
  /// Gives the half-edges at from(h), which is about to be drawn onto to(h), the transitions they have there.
  void draw(const TriangleLinks& links, int h);
};

/// O(V).
LooseMap loosen(const EditableAtlas& map);

/// The map of a refined surface of which `loose` says where its vertices lie. `base`, `fans`: its base complex. O(V).
EditableAtlas tighten(RefinedSurface refined, const LooseMap& loose, BaseComplex base, std::vector<BaseFan> fans);

}  // namespace gsp
