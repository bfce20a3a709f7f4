#include "mesh/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "mesh/halfedges.h"
#include "mesh/topology.h"

namespace gsp::shapes {

namespace {

constexpr double kPi = std::numbers::pi;

void project_to_sphere(Mesh& mesh, double radius) {
  for (Vec3& p : mesh.positions) p *= radius / p.norm();
}

/// Index of half-edge h's edge in the order of first appearance over the faces.
std::vector<int> edge_numbers(const Halfedges& he, int& edge_count) {
  std::vector<int> number(he.twin.size());
  edge_count = 0;
  for (int h = 0; h < static_cast<int>(number.size()); ++h)
    number[h] = he.twin[h] >= 0 && he.twin[h] < h ? number[he.twin[h]] : edge_count++;
  return number;
}

/// One step of umbrella smoothing by `factor`, all vertices at once. For closed meshes, where every neighbour is the
/// end of exactly one outgoing half-edge.
void smooth(Mesh& mesh, double factor) {
  std::vector<Vec3> sum(mesh.positions.size(), Vec3::Zero());
  std::vector<int> valence(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.faces)
    for (int k = 0; k < 3; ++k) {
      sum[t[k]] += mesh.positions[t[(k + 1) % 3]];
      ++valence[t[k]];
    }
  for (std::size_t v = 0; v < sum.size(); ++v)
    mesh.positions[v] = (1.0 - factor) * mesh.positions[v] + factor / valence[v] * sum[v];
}

/// Collects the unit squares that bound a set of unit cubes, each as two triangles, outward.
class CubeSurface {
 public:
  /// The square of the cube at `cell` on the side `axis`, positive or negative.
  void add_side(std::array<int, 3> cell, int axis, bool positive) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 4> corners;
    for (int k = 0; k < 4; ++k) {
      std::array<int, 3> p = cell;
      p[axis] += positive ? 1 : 0;
      p[u] += k == 1 || k == 2 ? 1 : 0;
      p[v] += k == 2 || k == 3 ? 1 : 0;
      corners[positive ? k : 3 - k] = vertex(p);
    }
    mesh_.faces.push_back({corners[0], corners[1], corners[2]});
    mesh_.faces.push_back({corners[0], corners[2], corners[3]});
  }

  Mesh take() { return std::move(mesh_); }

 private:
  int vertex(const std::array<int, 3>& p) {
    const auto [it, inserted] = index_.try_emplace(p, mesh_.vertex_count());
    if (inserted) mesh_.positions.emplace_back(p[0], p[1], p[2]);
    return it->second;
  }

  Mesh mesh_;
  std::map<std::array<int, 3>, int> index_;
};

}  // namespace

Mesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

Mesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

Mesh icosahedron() {
  const double g = std::numbers::phi;
  Mesh mesh{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  project_to_sphere(mesh, 1.0);
  return mesh;
}

Mesh sphere(int level, double radius) {
  Mesh mesh = icosahedron();
  for (int l = 0; l < level; ++l) {
    mesh = quadrisect(mesh);
    project_to_sphere(mesh, 1.0);
  }
  project_to_sphere(mesh, radius);
  return mesh;
}

Mesh bumpy_sphere(int level) {
  Mesh mesh = sphere(level);
  for (Vec3& p : mesh.positions) p *= 1.0 + 0.15 * std::sin(4.0 * p.x()) * std::cos(3.0 * p.y() + p.z());
  return mesh;
}

Mesh torus(int m, int n, double major, double minor) {
  Mesh mesh;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const double u = 2.0 * kPi * i / m, v = 2.0 * kPi * j / n;
      const double r = major + minor * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
    }
  const auto at = [&](int i, int j) { return (j % n) * m + i % m; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.faces.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

Mesh lattice_torus(int m, int n) { return torus(m, n); }

Mesh grid(int m, int n, double height) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) mesh.positions.emplace_back(i, j, height);
  const auto at = [&](int i, int j) { return j * (m + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.faces.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

Mesh sector_disc(int sectors, int level) {
  const int rings = 1 << level;
  Mesh mesh;
  mesh.positions.emplace_back(0, 0, 0);
  for (int d = 1; d <= rings; ++d)
    for (int s = 0; s < sectors; ++s)
      for (int t = 0; t < d; ++t) {
        const double x = (d - 0.5 * t) / rings, y = 0.5 * std::numbers::sqrt3 * t / rings;
        const double angle = (2.0 * kPi * s + 6.0 * std::atan2(y, x)) / sectors;
        const double radius = std::hypot(x, y);
        mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
      }
  const auto at = [&](int d, int s, int t) {
    return d == 0 ? 0 : 1 + sectors * d * (d - 1) / 2 + (s * d + t) % (sectors * d);
  };
  for (int s = 0; s < sectors; ++s)
    for (int d = 1; d <= rings; ++d)
      for (int t = 0; t < d; ++t) {
        mesh.faces.push_back({at(d - 1, s, t), at(d, s, t), at(d, s, t + 1)});
        if (t + 1 < d) mesh.faces.push_back({at(d - 1, s, t), at(d, s, t + 1), at(d - 1, s, t + 1)});
      }
  return mesh;
}

Mesh genus_slab(int genus, int level) {
  const std::array<int, 3> size = {2 * genus + 1, 3, 1};
  const auto filled = [&](const std::array<int, 3>& c) {
    for (int k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= size[k]) return false;
    return !(c[1] == 1 && c[0] % 2 == 1);
  };
  CubeSurface surface;
  for (int y = 0; y < size[1]; ++y)
    for (int x = 0; x < size[0]; ++x) {
      const std::array<int, 3> cell = {x, y, 0};
      if (!filled(cell)) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (int side : {-1, 1}) {
          std::array<int, 3> neighbour = cell;
          neighbour[axis] += side;
          if (!filled(neighbour)) surface.add_side(cell, axis, side > 0);
        }
    }
  Mesh mesh = surface.take();
  for (int l = 0; l < level; ++l) mesh = quadrisect(mesh);
  for (int step = 0; step < 3; ++step) smooth(mesh, 0.3);
  return mesh;
}

Mesh box(int level) {
  CubeSurface surface;
  for (int axis = 0; axis < 3; ++axis)
    for (bool positive : {false, true}) surface.add_side({0, 0, 0}, axis, positive);
  Mesh mesh = surface.take();
  for (int l = 0; l < level; ++l) mesh = quadrisect(mesh);
  return mesh;
}

Mesh cylinder(int sectors) {
  const int rings = sectors / 4 + 1, rows = 4 * rings;
  Mesh mesh{{{0.0, 0.0, -1.0}}, {}};
  for (int row = 1; row < rows; ++row) {
    const bool below = row<rings, above = row> 3 * rings;
    const double r = double(below ? row : above ? rows - row : rings) / rings;
    const double z = below ? -1.0 : above ? 1.0 : double(row - 2 * rings) / rings;
    for (int s = 0; s < sectors; ++s)
      mesh.positions.emplace_back(r * std::cos(2.0 * kPi * s / sectors), r * std::sin(2.0 * kPi * s / sectors), z);
  }
  mesh.positions.emplace_back(0.0, 0.0, 1.0);
  const int top = mesh.vertex_count() - 1;
  const auto at = [&](int row, int s) { return 1 + (row - 1) * sectors + s % sectors; };
  for (int s = 0; s < sectors; ++s) {
    mesh.faces.push_back({0, at(1, s + 1), at(1, s)});
    for (int row = 1; row + 1 < rows; ++row) {
      mesh.faces.push_back({at(row, s), at(row, s + 1), at(row + 1, s + 1)});
      mesh.faces.push_back({at(row, s), at(row + 1, s + 1), at(row + 1, s)});
    }
    mesh.faces.push_back({top, at(rows - 1, s), at(rows - 1, s + 1)});
  }
  return mesh;
}

Mesh lens(int level) {
  Mesh mesh = octahedron();
  for (int l = 0; l < level; ++l) mesh = quadrisect(mesh);
  for (Vec3& p : mesh.positions) {  // |x| + |y| + |z| is 1
    const double r = std::hypot(p.x(), p.y()), ratio = r > 0.0 ? (std::abs(p.x()) + std::abs(p.y())) / r : 0.0;
    const double side = p.z() > 0.0 ? 0.5 : p.z() < 0.0 ? -0.5 : 0.0;
    p = {p.x() * ratio, p.y() * ratio, 0.0};
    p.z() = side * (1.0 - p.squaredNorm());
  }
  return mesh;
}

Mesh twice(const Mesh& mesh, const Vec3& offset) {
  Mesh both = mesh;
  const int shift = mesh.vertex_count();
  for (const Vec3& p : mesh.positions) both.positions.push_back(p + offset);
  for (const Triangle& t : mesh.faces) both.faces.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return both;
}

Mesh quadrisect(const Mesh& mesh) {
  require_indices(mesh);
  const Halfedges he(mesh);
  int edge_count = 0;
  const std::vector<int> number = edge_numbers(he, edge_count);
  Mesh fine;
  fine.positions = mesh.positions;
  fine.positions.resize(mesh.positions.size() + edge_count);
  for (int h = 0; h < static_cast<int>(number.size()); ++h)
    fine.positions[mesh.positions.size() + number[h]] = 0.5 * (mesh.positions[he.from(h)] + mesh.positions[he.to(h)]);
  fine.faces.reserve(4 * mesh.faces.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.faces[f];
    const auto middle = [&](int k) { return mesh.vertex_count() + number[3 * f + k]; };
    const int ab = middle(0), bc = middle(1), ca = middle(2);
    fine.faces.push_back({a, ab, ca});
    fine.faces.push_back({ab, b, bc});
    fine.faces.push_back({ca, bc, c});
    fine.faces.push_back({ab, bc, ca});
  }
  return fine;
}

}  // namespace gsp::shapes
