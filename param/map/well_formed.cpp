#include <algorithm>
#include <cmath>

#include "mesh/error.h"
#include "mesh/topology.h"
#include "param/map/parameterization.h"

namespace gsp {

namespace {

/// Finite and small enough to be squared.
bool usable(double value) { return std::isfinite(value * value); }
bool usable(const Complex& z) { return usable(z.real()) && usable(z.imag()); }

void require_sizes(const Parameterization& map) {
  const std::size_t vertices = map.surface.positions.size(), faces = map.surface.faces.size();
  if (map.patch.size() != vertices || map.position.size() != vertices)
    throw Error(Cause::Malformed, "a map needs one patch and one position for each vertex");
  if (map.face_chart.size() != faces || map.face_corners.size() != faces)
    throw Error(Cause::Malformed, "a map needs one chart and three corners for each face");
  if (map.base.twins.size() != 3 * map.base.faces.size())
    throw Error(Cause::Malformed, "a base complex needs one twin for each half-edge");
}

void require_base(const Parameterization& map) {
  const BaseComplex& base = map.base;
  std::vector<char> named(map.surface.positions.size(), 0);
  for (int b = 0; b < base.vertex_count(); ++b) {
    const int v = base.vertices[b];
    if (v < 0 || v >= map.surface.vertex_count())
      throw Error(Cause::IndexOutOfRange, "a base vertex names a vertex that does not exist", Element::Vertex, b);
    if (named[v]++) throw Error(Cause::Malformed, "two base vertices are the same vertex", Element::Vertex, v);
  }
  for (int f = 0; f < base.face_count(); ++f) {
    const Triangle& t = base.faces[f];
    for (int corner : t)
      if (corner < 0 || corner >= base.vertex_count())
        throw Error(Cause::IndexOutOfRange, "a base face names a base vertex that does not exist", Element::Face, f);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      throw Error(Cause::Malformed, "a base face names a base vertex twice", Element::Face, f);
  }
  BaseComplex connected{base.vertices, base.faces, {}, {}};
  connected.connect();
  if (connected.twins != base.twins)
    throw Error(Cause::Malformed, "the base complex has other twins than its faces say");
}

void require_creases(const BaseComplex& base) {
  for (std::size_t i = 0; i < base.creases.size(); ++i)
    if (i > 0 && !(base.creases[i - 1] < base.creases[i]))
      throw Error(Cause::Malformed, "the creases of the base complex are not ascending");
  const std::vector<char> on_crease = base.crease_halfedges();
  std::size_t interior = 0;
  for (std::size_t h = 0; h < on_crease.size(); ++h) interior += on_crease[h] && base.twins[h] > static_cast<int>(h);
  if (interior != base.creases.size())
    throw Error(Cause::Malformed, "a crease of the base complex is no interior base edge");
}

void require_vertices(const Parameterization& map) {
  std::vector<char> used(map.surface.positions.size(), 0);
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (int v : map.surface.faces[f]) {
      if (v < 0 || v >= map.surface.vertex_count())
        throw Error(Cause::IndexOutOfRange, "a face names a vertex that does not exist", Element::Face, f);
      used[v] = 1;
    }
  require_computable(map.surface.positions);
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    if (!usable(map.position[v]))
      throw Error(Cause::NonFinite, "a position in a patch is not finite", Element::Vertex, v);
    if (map.patch[v] < (used[v] ? 0 : -1) || map.patch[v] >= map.base.face_count())
      throw Error(Cause::IndexOutOfRange, "a vertex lies in a base face that does not exist", Element::Vertex, v);
  }
}

}  // namespace

void require_well_formed(const Parameterization& map) {
  require_sizes(map);
  require_vertices(map);
  require_base(map);
  require_creases(map.base);
  for (int f = 0; f < map.surface.face_count(); ++f) {
    if (map.face_chart[f] < 0 || map.face_chart[f] >= map.base.face_count())
      throw Error(Cause::IndexOutOfRange, "a face lies in the chart of a base face that does not exist", Element::Face,
                  f);
    for (const Complex& corner : map.face_corners[f])
      if (!usable(corner)) throw Error(Cause::NonFinite, "a chart position is not finite", Element::Face, f);
  }
}

}  // namespace gsp
