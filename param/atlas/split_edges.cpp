#include "param/atlas/split_edges.h"

#include <numbers>
#include <vector>

#include "mesh/halfedges.h"

namespace gsp {

namespace {

/// Splits the edges that `wanted(halfedges, h)` names at their middles.
template <class Wanted>
std::vector<std::array<int, 2>> split_where(Mesh& mesh, Wanted&& wanted) {
  const Halfedges halfedges(mesh);
  std::vector<int> middle(3 * mesh.faces.size(), -1);
  std::vector<Vec3> added;
  std::vector<std::array<int, 2>> ends;
  for (int h = 0; h < static_cast<int>(middle.size()); ++h) {
    const int twin = halfedges.twin[h];
    if ((twin >= 0 && twin < h) || !wanted(halfedges, h)) continue;
    middle[h] = mesh.vertex_count() + static_cast<int>(added.size());
    if (twin >= 0) middle[twin] = middle[h];
    ends.push_back({halfedges.from(h), halfedges.to(h)});
    added.push_back(0.5 * (mesh.positions[halfedges.from(h)] + mesh.positions[halfedges.to(h)]));
  }
  mesh.positions.insert(mesh.positions.end(), added.begin(), added.end());
  const int old_faces = mesh.face_count();
  for (int f = 0; f < old_faces && !added.empty(); ++f) {
    const Triangle t = mesh.faces[f];
    const int* m = &middle[3 * f];
    if (m[0] >= 0 && m[1] >= 0 && m[2] >= 0) {
      mesh.faces[f] = {m[0], m[1], m[2]};
      for (int k = 0; k < 3; ++k) mesh.faces.push_back({t[k], m[k], m[(k + 2) % 3]});
      continue;
    }
    // The face as a polygon with its inserted middles, cut as a fan from the first middle, so that no cut joins two of
    // the face's own corners.
    std::vector<int> polygon;
    int first = -1;
    for (int k = 0; k < 3; ++k) {
      polygon.push_back(t[k]);
      if (m[k] < 0) continue;
      if (first < 0) first = static_cast<int>(polygon.size());
      polygon.push_back(m[k]);
    }
    if (first < 0) continue;
    const int n = static_cast<int>(polygon.size());
    for (int i = 1; i + 1 < n; ++i) {
      const Triangle piece{polygon[first], polygon[(first + i) % n], polygon[(first + i + 1) % n]};
      if (i == 1)
        mesh.faces[f] = piece;
      else
        mesh.faces.push_back(piece);
    }
  }
  return ends;
}

}  // namespace

std::vector<std::array<int, 2>> split_boundary_chords(Mesh& mesh) {
  return split_where(mesh, [](const Halfedges& halfedges, int h) {
    return halfedges.twin[h] >= 0 && halfedges.boundary_vertex(halfedges.from(h)) &&
           halfedges.boundary_vertex(halfedges.to(h));
  });
}

LongEdgeSplit split_long_edges(Mesh& mesh, double longest, int most) {
  const Mesh start = mesh;
  for (;; longest *= std::numbers::sqrt2, mesh = start) {
    LongEdgeSplit split{{}, longest};
    while (static_cast<int>(split.ends.size()) <= most) {
      const auto more = split_where(mesh, [&](const Halfedges& halfedges, int h) {
        return (mesh.positions[halfedges.to(h)] - mesh.positions[halfedges.from(h)]).norm() > longest;
      });
      if (more.empty()) return split;
      split.ends.insert(split.ends.end(), more.begin(), more.end());
    }
  }
}

}  // namespace gsp
