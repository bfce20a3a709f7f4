#include "remesh/remesh.h"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "mesh/error.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/map/development.h"
#include "tests/by_threads.h"
#include "tests/remesh/worst.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

SemiregularMesh silent_remesh(const Parameterization& map, int level) {
  Progress progress;
  progress.on_note([](const std::string& note) { FAIL_CHECK(note); });
  return remesh(map, {level, Positions::Sampled}, progress);
}

Mesh tent(int valence, int level) {
  Mesh disc = shapes::sector_disc(valence, level);
  for (Vec3& p : disc.positions) p.z() = 1.0 - p.norm() + 0.1 * p.x();
  return disc;
}

/// The exact inverse by search: each point of the remesh of `level` is looked for in every face of `map`, whose faces
/// must all be given in charts that hold them but for what jitter moved across an edge.
Vec3 inverse_by_search(const Parameterization& map, int chart, Complex z) {
  double best = -1e9;
  Vec3 found = Vec3::Zero();
  // The same point seen from its own chart and from the three beside it.
  std::vector<std::pair<int, Complex>> views = {{chart, z}};
  for (int h = 3 * chart; h < 3 * chart + 3; ++h)
    if (map.base.twins[h] >= 0) views.emplace_back(map.base.twins[h] / 3, map.base.across(h).apply(z));
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (const auto& [seen_from, at] : views) {
      if (map.face_chart[f] != seen_from) continue;
      const auto& c = map.face_corners[f];
      const double area = chart_area(c[0], c[1], c[2]);
      const double w[3] = {chart_area(at, c[1], c[2]) / area, chart_area(c[0], at, c[2]) / area,
                           chart_area(c[0], c[1], at) / area};
      const double smallest = std::min({w[0], w[1], w[2]});
      if (smallest <= best) continue;
      best = smallest;
      found.setZero();
      for (int k = 0; k < 3; ++k) found += w[k] * map.surface.positions[map.surface.faces[f][k]];
    }
  REQUIRE(best > -1e-9);
  return found;
}

/// Chart and position of every vertex of a remesh by the numbering rule: child k of a face keeps corner k, the last one
/// takes the midpoints.
std::vector<std::pair<int, Complex>> domain_places(const Mesh& base, int level) {
  struct Part {
    int chart;
    std::array<Complex, 3> z;
  };
  std::vector<Part> parts;
  for (int f = 0; f < base.face_count(); ++f)
    parts.push_back({f, {kChartCorners[0].value(), kChartCorners[1].value(), kChartCorners[2].value()}});
  for (int l = 0; l < level; ++l) {
    std::vector<Part> finer;
    for (const Part& p : parts) {
      const Complex ab = 0.5 * (p.z[0] + p.z[1]), bc = 0.5 * (p.z[1] + p.z[2]), ca = 0.5 * (p.z[2] + p.z[0]);
      finer.push_back({p.chart, {p.z[0], ab, ca}});
      finer.push_back({p.chart, {ab, p.z[1], bc}});
      finer.push_back({p.chart, {ca, bc, p.z[2]}});
      finer.push_back({p.chart, {ab, bc, ca}});
    }
    parts = std::move(finer);
  }
  const SubdivisionLevel finest = subdivision_levels(base.vertex_count(), base.faces, level).back();
  std::vector<std::pair<int, Complex>> places(finest.vertex_count);
  for (std::size_t f = 0; f < parts.size(); ++f)
    for (int k = 0; k < 3; ++k) places[finest.faces[f][k]] = {parts[f].chart, parts[f].z[k]};
  return places;
}

/// A flat torus of m x n base rhombi whose surface is a lattice of spacing 1/q sheared by `shear`: each face holds no
/// lattice point inside, yet reaches over about 2·shear/q base triangles.
struct ShearedTorus {
  int m, n, q, shear;
  Parameterization map;

  ShearedTorus(int m, int n, int q, int shear) : m(m), n(n), q(q), shear(shear) {
    const Mesh base = shapes::lattice_torus(m, n);
    map.base.faces = base.faces;
    for (int b = 0; b < m * n; ++b) map.base.vertices.push_back(vertex(q * (b % m), q * (b / m)));
    map.base.connect();
    Random random(1);
    for (int v = 0; v < q * m * q * n; ++v)
      map.surface.positions.emplace_back(random.uniform(), random.uniform(), random.uniform());
    map.patch.resize(map.surface.positions.size());
    map.position.resize(map.surface.positions.size());
    for (int j = 0; j < q * n; ++j)
      for (int i = 0; i < q * m; ++i) {
        const int cell = 2 * ((j / q) * m + i / q);
        const Complex z = lattice(i % q, j % q);
        const bool lower = i % q + j % q <= q;
        map.patch[vertex(i, j)] = lower ? cell : cell + 1;
        map.position[vertex(i, j)] = lower ? z : (z - 1.0) * omega_power(-1);
        add_face(i, j, {i, j}, {i + 1, j}, {i + shear, j + 1});
        add_face(i, j, {i + 1, j}, {i + 1 + shear, j + 1}, {i + shear, j + 1});
      }
  }

  int vertex(int i, int j) const { return ((j % (q * n) + q * n) % (q * n)) * q * m + (i % (q * m) + q * m) % (q * m); }
  Complex lattice(double i, double j) const { return {(i + kOmegaRe * j) / q, kOmegaIm * j / q}; }

  void add_face(int i, int j, std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c) {
    const int left = i / q * q, low = j / q * q;
    const auto corner = [&](const std::array<int, 2>& p) { return lattice(p[0] - left, p[1] - low); };
    map.surface.faces.push_back({vertex(a[0], a[1]), vertex(b[0], b[1]), vertex(c[0], c[1])});
    map.face_chart.push_back(2 * ((j / q) * m + i / q));
    map.face_corners.push_back({corner(a), corner(b), corner(c)});
  }

  /// The point of the surface over chart position z.
  Vec3 inverse(int chart, Complex z) const {
    if (chart % 2 == 1) z = 1.0 + z * omega_power(1);
    double y = z.imag() / kOmegaIm, x = z.real() - kOmegaRe * y;
    x = q * (x + chart / 2 % m);
    y = q * (y + chart / 2 / m);
    const double sheared = x - shear * y;
    const double i = std::floor(sheared + 1e-9), j = std::floor(y + 1e-9), s = sheared - i, t = y - j;
    const auto at = [&](int di, int dj) {
      const int row = static_cast<int>(j) + dj;
      return map.surface.positions[vertex(static_cast<int>(i) + di + shear * row, row)];
    };
    if (s + t <= 1.0) return (1.0 - s - t) * at(0, 0) + s * at(1, 0) + t * at(0, 1);
    return (1.0 - t) * at(1, 0) + (s + t - 1.0) * at(1, 1) + (1.0 - s) * at(0, 1);
  }
};

std::vector<Mesh> bases() {
  return {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(), shapes::lattice_torus(4, 5),
          shapes::grid(2, 3)};
}

}  // namespace

TEST_CASE("the remesh of a quadrisected base is that quadrisection, bit for bit at dyadic positions") {
  for (const Mesh& base : {shapes::tetrahedron(), shapes::octahedron(), shapes::grid(2, 3)})
    for (int map_level = 0; map_level <= 3; ++map_level)
      for (int level = 0; level <= 4; ++level) {
        const SemiregularMesh remeshed = silent_remesh(exact_maps::quadrisected(base, map_level), level);
        CHECK(remeshed.level == level);
        CHECK(remeshed.base_faces == base.faces);
        const auto places = domain_places(base, level);
        for (std::size_t v = 0; v < places.size(); ++v) {
          const std::array<double, 3> w = chart_barycentric(places[v].second);
          Vec3 p = Vec3::Zero();
          for (int k = 0; k < 3; ++k) p += w[k] * base.positions[base.faces[places[v].first][k]];
          CHECK((remeshed.positions[v] - p).norm() < 1e-14);
          if (map_level >= level) {
            // A vertex of the surface itself: exact.
            const Vec3 rounded = (p * 16.0).array().round() / 16.0;
            CHECK(remeshed.positions[v] == rounded);
          }
        }
      }
}

TEST_CASE("every point of the remesh of a distorted map is the exact inverse") {
  for (const Mesh& base : bases()) {
    Parameterization map = exact_maps::quadrisected(base, 2);
    exact_maps::jitter(map, 0.19, 2, 5);
    Random random(3);
    for (Vec3& p : map.surface.positions) p += 0.05 * Vec3(random.uniform(), random.uniform(), random.uniform());
    const SemiregularMesh remeshed = silent_remesh(map, 4);
    const auto places = domain_places(base, 4);
    REQUIRE(remeshed.positions.size() == places.size());
    for (std::size_t v = 0; v < places.size(); ++v)
      CHECK((remeshed.positions[v] - inverse_by_search(map, places[v].first, places[v].second)).norm() < 1e-12);
  }
}

TEST_CASE("in which chart a face is given makes no difference") {
  for (const Mesh& base : bases()) {
    Parameterization map = exact_maps::quadrisected(base, 2);
    exact_maps::jitter(map, 0.19, 2, 6);
    const SemiregularMesh before = silent_remesh(map, 3);
    exact_maps::rechart(map, 9);
    CHECK(worst(before.positions, silent_remesh(map, 3).positions) < 1e-12);
  }
}

TEST_CASE("corners of every valence: faces beside them reach the right sectors, flat or not") {
  for (int valence = 3; valence <= 12; ++valence) {
    const Mesh base = tent(valence, 0);
    Parameterization map = exact_maps::quadrisected(base, 1);
    exact_maps::jitter(map, 0.3, 1, valence);
    REQUIRE(check_map(map).valid());
    const SemiregularMesh remeshed = silent_remesh(map, 4);
    const auto places = domain_places(base, 4);
    for (std::size_t v = 0; v < places.size(); ++v)
      CHECK((remeshed.positions[v] - inverse_by_search(map, places[v].first, places[v].second)).norm() < 1e-12);
  }
}

TEST_CASE("a flat hexagon is reproduced whatever the vertices inside do, up to its boundary") {
  const Mesh base = shapes::sector_disc(6, 0);
  Parameterization map = exact_maps::quadrisected(base, 3);
  exact_maps::jitter(map, 0.19, 3, 2);
  exact_maps::flatten_onto_base(map, base);
  const SemiregularMesh remeshed = silent_remesh(map, 5);
  const SemiregularMesh exact = silent_remesh(exact_maps::quadrisected(base, 0), 5);
  CHECK(worst(remeshed.positions, exact.positions) < 1e-13);
}

TEST_CASE("faces that reach over many base triangles") {
  for (int q : {1, 2, 3})
    for (int shear : {0, 1, 2, 5, -4}) {
      const ShearedTorus torus(5, 4, q, shear);
      REQUIRE(check_map(torus.map).valid());
      const SemiregularMesh remeshed = silent_remesh(torus.map, 4);
      const auto places = domain_places(shapes::lattice_torus(5, 4), 4);
      double worst = 0.0;
      for (std::size_t v = 0; v < places.size(); ++v)
        worst = std::max(worst, (remeshed.positions[v] - torus.inverse(places[v].first, places[v].second)).norm());
      CHECK(worst < 1e-12);
    }
}

TEST_CASE("a face is visited once in each base triangle it reaches, so the cost stays linear") {
  for (int level = 2; level <= 5; ++level) {
    Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), level);
    exact_maps::jitter(map, 0.19, level, 1);
    std::vector<FacePiece> pieces;
    const Development development(map);
    for (int f = 0; f < map.surface.face_count(); ++f) development.append(f, pieces);
    // Only faces beside base edges have more than one piece: 30 edges, 2^level steps each, at most 6 faces a step.
    CHECK(static_cast<int>(pieces.size()) <= map.surface.face_count() + 30 * (1 << level) * 6);
  }
}

TEST_CASE("base vertices are the surface's own, isolated vertices do not matter") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 1);
  map.surface.positions.insert(map.surface.positions.end(), Vec3(9, 9, 9));
  map.patch.push_back(-1);
  map.position.push_back({});
  const SemiregularMesh remeshed = silent_remesh(map, 2);
  for (int b = 0; b < map.base.vertex_count(); ++b)
    CHECK(remeshed.positions[b] == map.surface.positions[map.base.vertices[b]]);
}

TEST_CASE("the automatic level is the first with as many faces as the surface, and 32,768") {
  Progress silent;
  RemeshOptions sampled;
  sampled.positions = Positions::Sampled;
  for (int map_level : {0, 3, 6, 7})
    CHECK(remesh(exact_maps::quadrisected(shapes::octahedron(), map_level), sampled, silent).level ==
          std::max(6, map_level));  // 8·4^6 = 32,768
}

TEST_CASE("folds are bridged, and told") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
  exact_maps::jitter(map, 1.2, 3, 3);
  REQUIRE(check_map(map).flipped_faces > 0);
  Progress progress;
  const SemiregularMesh remeshed = remesh(map, {4, Positions::Sampled}, progress);
  for (const Vec3& p : remeshed.positions) {
    CHECK(p.allFinite());
    CHECK((p.norm() < 1.0 + 1e-12 && p.norm() > 0.7));
  }
}

TEST_CASE("a hole in the map is filled from its rim, a chart that nothing covers is an error") {
  Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 3);
  map.surface.faces.erase(map.surface.faces.begin() + 30, map.surface.faces.begin() + 34);
  map.face_chart.erase(map.face_chart.begin() + 30, map.face_chart.begin() + 34);
  map.face_corners.erase(map.face_corners.begin() + 30, map.face_corners.begin() + 34);
  std::string told;
  Progress progress;
  progress.on_note([&](const std::string& note) { told = note; });
  for (const Vec3& p : remesh(map, {5}, progress).positions) CHECK(p.allFinite());
  CHECK(told.find("lie in no face") != std::string::npos);

  Parameterization empty = exact_maps::quadrisected(shapes::octahedron(), 2);
  for (auto& corners : empty.face_corners)
    for (Complex& c : corners) c = {};
  CHECK_THROWS_AS(remesh(empty, {3}, progress), Error);
}

TEST_CASE("hostile maps end in a result or an error") {
  Random random(4);
  Progress silent;
  for (int i = 0; i < 200; ++i) {
    Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 1);
    for (int damage = 0; damage < 4; ++damage) {
      const double size = std::pow(10.0, 150.0 * random.uniform() - 20.0);
      map.face_corners[random.next() % map.face_corners.size()][random.next() % 3] = {size, -size * random.uniform()};
      map.position[random.next() % map.position.size()] = {size, 0.0};
    }
    try {
      remesh(map, {3}, silent);
    } catch (const Error&) {
    }
  }
  SUCCEED();
}

TEST_CASE("levels out of range are refused") {
  const Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 0);
  Progress silent;
  CHECK_THROWS_AS(remesh(map, {-1}, silent), Error);
  CHECK_THROWS_AS(remesh(map, {11}, silent), Error);
}

TEST_CASE("one and two threads give the same bits", "[slow]") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 4);
  exact_maps::jitter(map, 0.5, 4, 6);
  Progress silent;
  const auto [one, two] = by_one_and_two_threads([&] { return remesh(map, {5}, silent); });
  CHECK(one.positions == two.positions);
}
