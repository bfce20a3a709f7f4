#include "param/atlas/surface.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace gsp {

namespace {

std::vector<double> voronoi_areas(const Mesh& mesh) {
  std::vector<double> area(mesh.positions.size(), 0.0);
  for (const Triangle& t : mesh.faces) {
    const Vec3 side[3] = {mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[1]],
                          mesh.positions[t[0]] - mesh.positions[t[2]]};
    const double twice = side[0].cross(side[1]).norm();
    double dot[3];  // at each corner, between the sides that leave it
    int obtuse = -1;
    for (int k = 0; k < 3; ++k) {
      dot[k] = -side[k].dot(side[(k + 2) % 3]);
      if (dot[k] < 0.0) obtuse = k;
    }
    for (int k = 0; k < 3; ++k) {
      if (twice <= 0.0) continue;
      if (obtuse >= 0) {
        area[t[k]] += twice * (k == obtuse ? 0.25 : 0.125);
      } else {
        const int n = (k + 1) % 3, p = (k + 2) % 3;
        // Σ cot(opposite angle)·|side|² / 8 over the two sides at the corner
        area[t[k]] += (dot[p] * side[k].squaredNorm() + dot[n] * side[p].squaredNorm()) / (8.0 * twice);
      }
    }
  }
  return area;
}

/// Splits the edges that `wanted(halfedges, h)` names at their middles.
template <class Wanted>
int split_where(Mesh& mesh, Wanted&& wanted) {
  const Halfedges halfedges(mesh);
  std::vector<int> middle(3 * mesh.faces.size(), -1);
  std::vector<Vec3> added;
  for (int h = 0; h < static_cast<int>(middle.size()); ++h) {
    const int twin = halfedges.twin[h];
    if ((twin >= 0 && twin < h) || !wanted(halfedges, h)) continue;
    middle[h] = mesh.vertex_count() + static_cast<int>(added.size());
    if (twin >= 0) middle[twin] = middle[h];
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
  return static_cast<int>(added.size());
}

}  // namespace

Surface::Surface(Mesh input) : mesh(std::move(input)), halfedges(mesh) {
  edge_of.assign(3 * mesh.faces.size(), -1);
  for (int h = 0; h < static_cast<int>(edge_of.size()); ++h) {
    const int twin = halfedges.twin[h];
    if (twin >= 0 && twin < h) {
      edge_of[h] = edge_of[twin];
    } else {
      edge_of[h] = edge_count();
      edge_halfedge.push_back(h);
    }
  }
  vertex_area = voronoi_areas(mesh);
  for (int f = 0; f < mesh.face_count(); ++f) face_area.push_back(gsp::face_area(mesh, f));
}

Surface::Surface(Mesh input, std::vector<double> areas) : Surface(std::move(input)) {
  face_area = std::move(areas);
  std::fill(vertex_area.begin(), vertex_area.end(), 0.0);
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int v : mesh.faces[f]) vertex_area[v] += face_area[f] / 3.0;
}

std::vector<int> vertices_of(const std::vector<Triangle>& faces, const std::vector<int>& some) {
  std::vector<int> vertices;
  for (int f : some) vertices.insert(vertices.end(), faces[f].begin(), faces[f].end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<int> faces_around(const Surface& surface, const std::vector<int>& vertices) {
  std::vector<int> faces;
  for (int v : vertices) {
    const int start = surface.halfedges.outgoing[v];
    for (int h = start; h >= 0;) {
      faces.push_back(Halfedges::face(h));
      h = surface.halfedges.rotate_ccw(h);
      if (h == start) break;
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

int split_boundary_chords(Mesh& mesh) {
  return split_where(mesh, [](const Halfedges& halfedges, int h) {
    return halfedges.twin[h] >= 0 && halfedges.boundary_vertex(halfedges.from(h)) &&
           halfedges.boundary_vertex(halfedges.to(h));
  });
}

int split_long_edges(Mesh& mesh, double longest) {
  int added = 0;
  while (true) {
    const int more = split_where(mesh, [&](const Halfedges& halfedges, int h) {
      return (mesh.positions[halfedges.to(h)] - mesh.positions[halfedges.from(h)]).norm() > longest;
    });
    if (more == 0) return added;
    added += more;
  }
}

}  // namespace gsp
