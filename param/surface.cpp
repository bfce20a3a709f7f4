#include "param/surface.h"

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
}

int split_boundary_chords(Mesh& mesh) {
  const Halfedges halfedges(mesh);
  std::vector<int> middle(3 * mesh.faces.size(), -1);
  int added = 0;
  for (int h = 0; h < static_cast<int>(middle.size()); ++h) {
    const int twin = halfedges.twin[h];
    if (twin < h || !halfedges.boundary_vertex(halfedges.from(h)) || !halfedges.boundary_vertex(halfedges.to(h)))
      continue;
    middle[h] = middle[twin] = mesh.vertex_count();
    mesh.positions.push_back(0.5 * (mesh.positions[halfedges.from(h)] + mesh.positions[halfedges.to(h)]));
    ++added;
  }
  const int old_faces = mesh.face_count();
  for (int f = 0; f < old_faces && added > 0; ++f) {
    // The face as a polygon with its inserted middles, cut as a fan from the first middle, so that no cut joins two
    // boundary vertices.
    std::vector<int> polygon;
    int first = -1;
    for (int k = 0; k < 3; ++k) {
      polygon.push_back(mesh.faces[f][k]);
      if (middle[3 * f + k] < 0) continue;
      if (first < 0) first = static_cast<int>(polygon.size());
      polygon.push_back(middle[3 * f + k]);
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
  return added;
}

}  // namespace gsp
