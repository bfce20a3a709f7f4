#include "thin_shapes.h"

#include <cmath>
#include <numbers>

#include "mesh/shapes.h"

namespace gsp::thin_shapes {

namespace {

constexpr double kPi = std::numbers::pi;

/// Adds a polygon's corners at a height.
void add_ring(Mesh& mesh, int sides, double radius, double z) {
  for (int i = 0; i < sides; ++i)
    mesh.positions.emplace_back(radius * std::cos(2.0 * kPi * i / sides), radius * std::sin(2.0 * kPi * i / sides), z);
}

/// Joins two rings of as many corners, given by their first vertices; the faces look outward where `upper` is above.
void join_rings(Mesh& mesh, int sides, int lower, int upper) {
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    mesh.faces.push_back({lower + i, lower + next, upper + i});
    mesh.faces.push_back({lower + next, upper + next, upper + i});
  }
}

/// A fan about a new vertex; looking along -z it turns counter-clockwise, or clockwise where it looks down.
void close_ring(Mesh& mesh, int sides, int ring, const Vec3& middle, bool down) {
  const int tip = mesh.vertex_count();
  mesh.positions.push_back(middle);
  for (int i = 0; i < sides; ++i) {
    const int a = ring + i, b = ring + (i + 1) % sides;
    mesh.faces.push_back(down ? Triangle{tip, b, a} : Triangle{tip, a, b});
  }
}

void scale_x(Mesh& mesh, double factor) {
  for (Vec3& p : mesh.positions) p.x() *= factor;
}

}  // namespace

Mesh tube(int sides, int rings, double length) {
  Mesh mesh;
  for (int r = 0; r <= rings; ++r) add_ring(mesh, sides, 1.0, length * r / rings);
  for (int r = 0; r < rings; ++r) join_rings(mesh, sides, r * sides, (r + 1) * sides);
  return mesh;
}

Mesh rod(int sides, int rings, double length) {
  Mesh mesh = tube(sides, rings, length);
  close_ring(mesh, sides, 0, {0.0, 0.0, 0.0}, true);
  close_ring(mesh, sides, rings * sides, {0.0, 0.0, length}, false);
  return mesh;
}

Mesh box(double x, double y, double z) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? x : 0.0, i & 2 ? y : 0.0, i & 4 ? z : 0.0);
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

Mesh needle(int sides, double length, bool open) {
  Mesh mesh;
  add_ring(mesh, sides, 1.0, 0.0);
  close_ring(mesh, sides, 0, {0.0, 0.0, length}, false);
  if (!open) close_ring(mesh, sides, 0, {0.0, 0.0, 0.0}, true);
  return mesh;
}

Mesh ellipsoid(int level, double stretch) {
  Mesh mesh = shapes::sphere(level);
  scale_x(mesh, stretch);
  return mesh;
}

Mesh strip(int m, int n, double length) {
  Mesh mesh = shapes::grid(m, n);
  for (Vec3& p : mesh.positions) p = {p.x() * length / m, p.y() / n, 0.0};
  return mesh;
}

Mesh bored_plate(int sides, double radius, double thickness) {
  const auto add_square = [&](Mesh& mesh, double z) {
    const Vec3 corner[4] = {{1.0, 1.0, z}, {-1.0, 1.0, z}, {-1.0, -1.0, z}, {1.0, -1.0, z}};
    for (int i = 0; i < 4; ++i) mesh.positions.push_back(corner[i]);
  };
  // The hole's corner i sees the square's corner of its quarter; at the end of each quarter the square's side follows.
  const auto add_sheet = [&](Mesh& mesh, int square, int hole, bool up) {
    const auto add = [&](int a, int b, int c) { mesh.faces.push_back(up ? Triangle{a, b, c} : Triangle{a, c, b}); };
    for (int i = 0; i < sides; ++i) {
      const int quarter = i / (sides / 4), next = (i + 1) % sides;
      add(hole + i, square + quarter, hole + next);
      if ((i + 1) % (sides / 4) == 0) add(hole + next, square + quarter, square + (quarter + 1) % 4);
    }
  };
  Mesh mesh;
  add_square(mesh, 0.0);
  add_ring(mesh, sides, radius, 0.0);
  if (thickness <= 0.0) {
    add_sheet(mesh, 0, 4, true);
    return mesh;
  }
  add_square(mesh, thickness);
  add_ring(mesh, sides, radius, thickness);
  add_sheet(mesh, 0, 4, false);
  add_sheet(mesh, 4 + sides, 8 + sides, true);
  join_rings(mesh, 4, 0, 4 + sides);
  const int wall = mesh.face_count();
  join_rings(mesh, sides, 4, 8 + sides);
  for (int f = wall; f < mesh.face_count(); ++f) std::swap(mesh.faces[f][1], mesh.faces[f][2]);
  return mesh;
}

Mesh fan(int faces, double stretch) {
  Mesh mesh;
  add_ring(mesh, faces, 1.0, 0.0);
  close_ring(mesh, faces, 0, {0.0, 0.0, 0.0}, false);
  scale_x(mesh, stretch);
  return mesh;
}

Mesh foil(int m, double gap) {
  Mesh mesh = strip(m, m, 1.0);
  for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
  const Mesh above = shapes::grid(m, m);
  const int count = mesh.vertex_count();
  for (int v = 0; v < count; ++v) mesh.positions.push_back(mesh.positions[v] + Vec3(0.0, 0.0, gap));
  for (const Triangle& t : above.faces) mesh.faces.push_back({t[0] + count, t[1] + count, t[2] + count});
  const auto wall = [&](int from, int step) {
    for (int i = 0; i < m; ++i, from += step) {
      mesh.faces.push_back({from, from + step, from + count});
      mesh.faces.push_back({from + step, from + step + count, from + count});
    }
  };
  const int row = m + 1;
  wall(0, 1);
  wall(m, row);
  wall(row * row - 1, -1);
  wall(m * row, -row);
  return mesh;
}

Mesh triangle(double height) { return {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, height, 0.0}}, {{0, 1, 2}}}; }

Mesh graded_grid(int m, double ratio) {
  Mesh mesh = shapes::grid(m, m);
  const double factor = m > 1 ? std::pow(ratio, -1.0 / (m - 1)) : 1.0;
  std::vector<double> at{0.0};
  for (int i = 0; i < m; ++i) at.push_back(at.back() + std::pow(factor, i));
  for (Vec3& p : mesh.positions) p = {at[std::lround(p.x())] / at[m], at[std::lround(p.y())] / at[m], 0.0};
  return mesh;
}

Mesh spike(int level, double length) {
  Mesh mesh = shapes::sphere(level);
  mesh.positions[0] *= length;
  return mesh;
}

std::vector<Shape> family(double aspect) {
  return {{"rod of 8 sides", rod(8, 1, aspect)},
          {"rod of 48 sides", rod(48, 1, aspect)},
          {"rod of 16 rows", rod(8, 16, aspect)},
          {"box", box(aspect, 1.0, 1.0)},
          {"box off the axes", box(aspect, 1.0, 0.5)},
          {"plate", box(1.0, 1.0, 1.0 / aspect)},
          {"blade", box(aspect, std::sqrt(aspect), 1.0)},
          {"needle", needle(16, aspect, false)},
          {"open cone", needle(16, aspect, true)},
          {"tube", tube(12, 1, aspect)},
          {"tube of 20 rows", tube(12, 20, aspect)},
          {"long ellipsoid", ellipsoid(3, aspect)},
          {"lens", ellipsoid(3, 1.0 / aspect)},
          {"thin torus", shapes::torus(24, 8, aspect, 1.0)},
          {"strip of 2 faces", strip(1, 1, aspect)},
          {"strip of 40 columns", strip(40, 2, aspect)},
          {"sheet with a bore", bored_plate(24, 1.0 / aspect, 0.0)},
          {"plate with a bore", bored_plate(24, 1.0 / aspect, 0.1)},
          {"foil with a bore", bored_plate(24, 0.1, 1.0 / aspect)},
          {"fan", fan(64, aspect / 10.0)},
          {"foil", foil(12, 1.0 / aspect)},
          {"triangle", triangle(1.0 / aspect)},
          {"graded grid", graded_grid(16, aspect)},
          {"spike", spike(3, aspect)}};
}

}  // namespace gsp::thin_shapes
