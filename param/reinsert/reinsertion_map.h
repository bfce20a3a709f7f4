#pragma once

#include <optional>

#include "param/refined/editable_atlas.h"
#include "param/removal/removal_record.h"

namespace gsp {

/// The map of a complex between two levels: what a decimation left, with part of its vertices back in. Vertices are
/// numbered as in the finer surface, those that were added to the coarser one come after them. References must outlive
/// it.
struct ReinsertionMap {
  /// Where an added vertex lies: the vertices of the complex's triangle, and their weights, 0 for one of them on an
  /// edge.
  struct Support {
    Triangle corners{-1, -1, -1};
    std::array<double, 3> weights{};
    double weight_of(int corner) const;
  };

  const RemovalRecord& decimation;
  const BaseComplex& base;
  const std::vector<BaseFan>& fans;
  TriangleLinks links;
  LooseMap loose;
  std::vector<int> slot;       ///< per face, the complex's triangle that it is a piece of
  std::vector<Support> added;  ///< of the added vertices

  /// `map`: of what the decimation left.
  ReinsertionMap(const RemovalRecord& decimation, const EditableAtlas& map);

  int own_vertices() const { return decimation.surface->mesh.vertex_count(); }
  bool is_added(int v) const { return v >= own_vertices(); }
  const Support& support(int v) const { return added[v - own_vertices()]; }
  bool boundary(int v) const { return !is_added(v) && decimation.surface->halfedges.boundary_vertex(v); }
  Vec3 on_surface(int v) const;

  /// Transitions of a face's corners to one chart: that of a corner of it which is no patch corner, on a boundary if
  /// one is.
  Atlas::FaceFrame frame(int face) const;
  /// The frame of the face behind h as it continues that of the face before it, `from`. Nothing where they do not fit.
  std::optional<Atlas::FaceFrame> frame_across(int h, const Atlas::FaceFrame& from) const;

  /// The base face at the boundary edge between two patch corners, which lie at the given places in some chart, and the
  /// change from that chart. Nothing where there is no such edge.
  std::optional<Arrival> boundary_seat(int from, int to, Complex at_from, Complex at_to) const;
  void change_chart(int vertex, const Arrival& arrival);

  /// A further added vertex, whose support is not set.
  int add_vertex();
  /// Puts a vertex on the edge of h at a share of the way from its start, or into a face with the weights of its
  /// corners; the map stays what it is. New faces come last. False where the charts of the edge's two faces do not fit.
  bool split(int h, double share, int middle);
  void insert(int face, const std::array<double, 3>& weights, int middle);

  /// Some faces as a map of their own, with vertices numbered by `vertices`. O(base + faces).
  Atlas part(const std::vector<int>& faces, std::vector<int>& vertices) const;

  /// When all vertices are back in. O(V).
  EditableAtlas finish() &&;

 private:
  Atlas::FaceFrame own_frame(int face) const;
  bool knows_chart(int face) const;
  void connect(int face, const std::array<Transition, 3>& into, int middle);
};

}  // namespace gsp
