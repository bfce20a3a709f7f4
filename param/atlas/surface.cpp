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

}  // namespace

Seams Seams::of(const std::vector<int>& vertices) const {
  if (!any()) return {};
  Seams some{std::vector<int>(vertices.size(), -1), std::vector<int>(vertices.size(), -1), points};
  std::vector<int> number(point.size(), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (point_of(vertices[i]) >= 0) number[vertices[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    some.point[i] = point_of(vertices[i]);
    if (const int mate = other_of(vertices[i]); mate >= 0) some.other[i] = number[mate];
  }
  return some;
}

int Seams::count_whole(const std::vector<int>& vertices) const {
  std::vector<char> seen(points, 0);
  int count = 0;
  for (int v : vertices) {
    const int at = point_of(v);
    count += at < 0 || !seen[at];
    if (at >= 0) seen[at] = 1;
  }
  return count;
}

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
  fan_size.assign(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.faces)
    for (int v : t) ++fan_size[v];
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

}  // namespace gsp
