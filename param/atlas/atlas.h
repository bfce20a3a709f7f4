#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "param/atlas/surface.h"
#include "param/map/base_fan.h"
#include "param/map/parameterization.h"

namespace gsp {

/// A map in the making: every vertex of the surface has a chart and a position in it, every edge an exact change of
/// chart. Moving a vertex to another chart changes the transitions of its edges by one composition and nothing else
/// (algorithms.md §1).
class Atlas {
 public:
  std::shared_ptr<const Surface> surface;
  BaseComplex base;
  std::vector<BaseFan> fans;  ///< per base vertex
  /// The vertices from here on were added to the surface for this map alone, and do not become patch corners.
  int first_added = std::numeric_limits<int>::max();
  std::vector<int> corner;        ///< #V base vertex of a patch corner, -1 for all others
  std::vector<int> patch;         ///< #V chart; of a corner any around it; -1 for isolated vertices
  std::vector<Complex> position;  ///< #V in that chart
  /// #E from the chart of the edge's end to that of its start, by the edge's direction. At a corner it is defined up to
  /// turns about the corner, which leave the corner's position where it is.
  std::vector<Transition> transition;

  /// From the chart of the other end to that of the end at which `forward` says the edge starts.
  Transition towards(int edge, bool forward) const { return forward ? transition[edge] : transition[edge].inverse(); }

  /// Whether the vertex may go anywhere: it is neither a patch corner nor on a boundary, nor isolated.
  bool is_free(int vertex) const {
    return patch[vertex] >= 0 && corner[vertex] < 0 && !surface->halfedges.boundary_vertex(vertex);
  }

  /// Changes the chart of a vertex that is no corner; `change` maps the old chart to the new one.
  void change_chart(int vertex, int chart, const Transition& change);

  /// Gives a vertex that lies outside its chart's triangle the chart where it lies. The edge from a neighbour that lies
  /// inside its own, and is no patch corner, is straight in the neighbour's chart and leads there; between patch
  /// corners alone the walk starts at a place of the chart that the whole ring sees. Returns false, and leaves the
  /// vertex as it was, where there is no such neighbour yet, or the way leaves the base.
  bool reassign(int vertex);

  /// The same for all free vertices, from neighbour to neighbour; where the neighbours of some are all outside or patch
  /// corners their walk starts at such a place too. Returns how many still lie outside.
  int reassign_all();

  /// Transitions of the face's corners into a common chart, that of corner `reference` (0..2). Around a face no corner
  /// of which is a patch corner the result does not depend on the reference.
  struct FaceFrame {
    int chart = -1;
    std::array<Transition, 3> to_chart;
  };
  FaceFrame face_frame(int face) const;
  /// The frame of a face between three patch corners, whose transitions hold up to turns about them. By corner of the
  /// face: base vertex, chart and position in it; `first`, `third`: from the charts of corners 1 and 2 to that of
  /// corner 0, `between`: from that of 2 to that of 1.
  struct CornerFace {
    std::array<int, 3> corner, patch;
    std::array<Complex, 3> position;
    Transition first, third, between;
  };
  static FaceFrame corner_frame(const BaseComplex& base, const std::vector<BaseFan>& fans, const CornerFace& face);
  std::array<Complex, 3> face_corners(int face, const FaceFrame& frame) const;

  /// Number of faces without patch corners around which the transitions do not compose to the identity: 0 always holds.
  int broken_faces() const;

  Parameterization finish(std::vector<std::string> provenance) const;

 private:
  bool reassign_from_ring(int vertex);
  /// From the chart of a half-edge's head to that of its tail, or back.
  Transition along(int h, bool reverse) const {
    const int edge = surface->edge_of[h];
    return towards(edge, (surface->edge_halfedge[edge] == h) != reverse);
  }
};

/// The atlas of a map every face of which lies in one base face, whose chart it is given in, such as that of a remesh
/// onto its own base. Throws Error(Internal) where a vertex is in the patch of a base face that is not beside its
/// faces' ones.
Atlas atlas_of(const Parameterization& map);

}  // namespace gsp
