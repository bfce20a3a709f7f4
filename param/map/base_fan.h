#pragma once

#include <array>
#include <optional>
#include <vector>

#include "param/map/base_complex.h"

namespace gsp {

/// The base faces around one base vertex, counter-clockwise, and how each lies in the plane developed about it.
struct BaseFan {
  struct Sector {
    int face;
    int corner;  ///< index of the base vertex in the face
  };
  bool boundary = false;
  std::vector<Sector> sectors;

  int valence() const { return static_cast<int>(sectors.size()); }
  /// Chart of sector `s` (any integer; around an interior vertex taken modulo the valence) into the plane developed
  /// about the vertex: the vertex at 0, sector 0 between the angles 0 and 60°, sector s between s·60° and (s+1)·60°.
  Transition develop(int s) const;
  const Sector& sector(int s) const;
  /// The sector in which `face` lies, -1 if the face is not around the vertex.
  int find(int face) const;
  /// From the chart of a face around the vertex to that of sector 0, by the way about the vertex.
  Transition to_first_sector(int face) const { return develop(0).inverse() * develop(find(face)); }
};

std::vector<BaseFan> base_fans(const BaseComplex& base);
/// That of the base vertex which a half-edge leaves.
BaseFan base_fan(const BaseComplex& base, int halfedge);

/// The base face with three base vertices in that order, -1 where there is none.
int find_base_face(const BaseComplex& base, const std::vector<BaseFan>& fans, const std::array<int, 3>& corners);

/// The half-edge from base vertex a to b, -1 where there is none.
int find_base_edge(const BaseComplex& base, const std::vector<BaseFan>& fans, int a, int b);

/// Whether a point lies in its chart's triangle, or outside by rounding.
bool inside_chart(Complex z);

/// Where a straight walk over the base ends.
struct Arrival {
  int chart;
  Transition change;    ///< from the chart where the walk starts
  bool reached = true;  ///< false where it came to the base's boundary before its goal
};
/// Walks straight between two points given in one chart, of which the first lies in the chart's triangle, across base
/// edges until the second lies in the triangle too, or at the base's boundary. A walk from a base vertex goes through
/// the chart's own sector. `sides` receives the half-edges that it crosses, each of the face that it leaves. O(base
/// faces crossed).
Arrival walk_straight(const BaseComplex& base, int chart, Complex from, Complex to, std::vector<int>* sides = nullptr);

/// The same, with nothing where the walk leaves the base.
std::optional<Arrival> follow(const BaseComplex& base, int chart, Complex from, Complex to,
                              std::vector<int>* sides = nullptr);

}  // namespace gsp
