#include "param/baselines/smoothed_domain.h"

#include <catch2/catch.hpp>

#include "mesh/shapes.h"
#include "param/parameterize.h"

using namespace gsp;

namespace {

constexpr int kLevels = 4;

/// A base complex whose faces have the shapes of a mesh's faces.
struct Shaped {
  BaseComplex base;
  std::vector<std::array<Complex, 3>> corners;

  explicit Shaped(const Mesh& mesh) {
    for (int v = 0; v < mesh.vertex_count(); ++v) base.vertices.push_back(v);
    base.faces = mesh.faces;
    base.connect();
    corners = true_shapes(base, mesh.positions);
  }
};

Mesh octahedron(double height) {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, height}, {0.9, 0, -height}};
  for (int k = 0; k < 4; ++k) {
    mesh.faces.push_back({k, (k + 1) % 4, 4});
    mesh.faces.push_back({(k + 1) % 4, k, 5});
  }
  return mesh;
}

template <class Visit>
void for_each_dyadic(const SmoothedDomain& domain, Visit&& visit) {
  const int n = domain.steps();
  for (int f = 0; f < domain.base().face_count(); ++f)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        visit(f, chart_area(domain.at(f, i, j), domain.at(f, i + 1, j), domain.at(f, i, j + 1)));
        if (i + j < n - 1)
          visit(f, chart_area(domain.at(f, i + 1, j), domain.at(f, i + 1, j + 1), domain.at(f, i, j + 1)));
      }
}

}  // namespace

TEST_CASE("Loop on the parameters moves nothing where the domain is a regular lattice") {
  Mesh hexagon;
  hexagon.positions.push_back(Vec3::Zero());
  for (int k = 0; k < 6; ++k) {
    hexagon.positions.push_back({std::cos(M_PI / 3 * k), std::sin(M_PI / 3 * k), 0.0});
    hexagon.faces.push_back({0, 1 + k, 1 + (k + 1) % 6});
  }
  const Shaped shape(hexagon);
  const SmoothedDomain domain(shape.base, shape.corners, kLevels);
  CHECK(domain.steps() == 1 << kLevels);
  CHECK(domain.shortened() == 0);
  const double n = domain.steps();
  for (int f = 0; f < 6; ++f)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) {
        const auto& c = domain.corners(f);
        const Complex straight = ((n - i - j) * c[0] + double(i) * c[1] + double(j) * c[2]) / n;
        CHECK(std::abs(domain.at(f, i, j) - straight) < 1e-12);
      }
}

TEST_CASE("Loop on the parameters covers the domain once, however thin its faces are") {
  for (double height : {0.05, 1.0, 20.0}) {
    INFO("height " << height);
    const Shaped shape(octahedron(height));
    const SmoothedDomain domain(shape.base, shape.corners, kLevels);
    double least = 1.0, covered = 0.0, whole = 0.0;
    for (const auto& c : shape.corners) whole += chart_area(c[0], c[1], c[2]);
    for_each_dyadic(domain, [&](int, double area) {
      least = std::min(least, area);
      covered += area;
    });
    CHECK(least > 0.0);
    CHECK(covered == Approx(whole).epsilon(1e-12));
    const int n = domain.steps();
    for (int f = 0; f < shape.base.face_count(); ++f)
      for (int i = 0; i <= n; ++i) {  // along edge 0, from both sides
        const int twin = shape.base.twins[3 * f], k = twin % 3, back = n - i;
        std::array<int, 3> weight{};
        weight[k] = n - back;
        weight[(k + 1) % 3] = back;
        CHECK(std::abs(domain.unfold(3 * f).apply(domain.at(twin / 3, weight[1], weight[2])) - domain.at(f, i, 0)) <
              1e-9);
      }
  }
}

TEST_CASE(
    "MAPS' map smoothed by Loop keeps nearly all faces upright, for dyadic triangles that leave their patch too") {
  struct {
    const char* name;
    Mesh mesh;
    int base_vertices;
  } const cases[] = {{"bumpy sphere", shapes::bumpy_sphere(5), 8},
                     {"torus", shapes::torus(120, 50), 12},
                     {"open grid", shapes::grid(60, 50, 0.1), 8}};
  for (const auto& c : cases) {
    INFO(c.name);
    ParameterizeOptions options;
    options.base_vertices = c.base_vertices;
    options.method = Method::MapsSmoothed;
    Progress progress;
    const MapCheck check = check_map(parameterize(c.mesh, options, progress).map);
    CHECK(check.flipped_faces * 500 <= c.mesh.face_count());
    CHECK(check.torn_edges == 0);
    CHECK(check.misplaced_vertices == 0);
  }
}
