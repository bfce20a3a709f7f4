#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "brute_force.h"
#include "mesh/nearest/triangle_tree.h"
#include "mesh/shapes.h"
#include "metrics/quantile_histogram.h"
#include "metrics/sample_density.h"
#include "metrics/sampled_distance.h"
#include "metrics/singular_values.h"
#include "metrics/statistics.h"
#include "metrics/surface_tree_impl.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

TEST_CASE("statistics of weighted numbers, by hand") {
  const Statistics s = statistics({{3.0, 1.0}, {1.0, 2.0}, {10.0, 0.0}, {2.0, 5.0}, {8.0, 2.0}});
  CHECK(s.minimum == 1.0);
  CHECK(s.maximum == 8.0);  // what has no weight does not count
  CHECK(s.mean == Approx((3 + 2 + 10 + 16) / 10.0));
  CHECK(s.median == 2.0);
  CHECK(s.p05 == 1.0);
  CHECK(s.p95 == 8.0);
  const Statistics none = statistics({{5.0, 0.0}});
  CHECK(none.maximum == 0.0);
  CHECK(statistics({}).mean == 0.0);
}

TEST_CASE("quantiles of a histogram are within a bin of the true ones, in any unit") {
  for (double unit : {1.0, 1e-9, 3e7}) {
    QuantileHistogram histogram(unit);
    for (int k = 1; k <= 1000; ++k) histogram.add(unit * k * 1e-3, k % 2 ? 1.0 : 3.0);
    for (double share : {0.05, 0.5, 0.95})
      CHECK(histogram.quantile(share) == Approx(unit * share).epsilon(std::ldexp(1.0, -11) + 2e-3 / share));
  }
  QuantileHistogram empty(1.0);
  CHECK(empty.quantile(0.5) == 0.0);
  QuantileHistogram zeros(1.0);
  for (int k = 0; k < 3; ++k) zeros.add(0.0, 1.0);
  zeros.add(7.0, 1.0);
  CHECK(zeros.quantile(0.5) < 1e-30);
  CHECK(zeros.quantile(0.9) == Approx(7.0).epsilon(1e-3));
}

TEST_CASE("a face's map has the singular values of the stretch that made it") {
  Parameterization map = exact_maps::quadrisected(shapes::lattice_torus(3, 3), 1);
  // Each face of the surface is the face of the chart stretched by 3 and 1/2.
  map.surface.positions.clear();
  for (std::size_t f = 0; f < map.surface.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Complex z = map.face_corners[f][k];
      map.surface.positions.emplace_back(3.0 * z.real(), 0.5 * z.imag(), 1.0);
      map.surface.faces[f][k] = static_cast<int>(3 * f) + k;
    }
  const std::vector<FaceMap> faces = face_maps(map);
  for (const FaceMap& f : faces) {
    CHECK(f.counted());
    CHECK(f.largest == Approx(3.0));
    CHECK(f.smallest == Approx(0.5));
    CHECK(f.chart_area == Approx(kChartArea / 4));
    CHECK(f.surface_area == Approx(1.5 * kChartArea / 4));
  }
  CHECK(area_scale(faces) == Approx(1.5));
  // Turned over in its chart: the mirror image's values, and a negative area.
  std::swap(map.face_corners[0][1], map.face_corners[0][2]);
  std::swap(map.surface.faces[0][1], map.surface.faces[0][2]);
  const FaceMap turned = face_map(map, 0);
  CHECK(turned.largest == Approx(3.0));
  CHECK(turned.smallest == Approx(0.5));
  CHECK(turned.chart_area == Approx(-kChartArea / 4));
  map.face_corners[1] = {Complex(0), Complex(1), Complex(2)};
  CHECK_FALSE(face_map(map, 1).counted());
  CHECK(area_scale({}) == 1.0);
}

TEST_CASE("the tree finds the nearest triangle from any hint, alone and in groups") {
  Random random(19);
  Mesh mesh = shapes::bumpy_sphere(2);
  mesh.faces.resize(200);
  const TriangleTree tree(mesh);
  for (int f = 0; f < mesh.face_count(); ++f) CHECK(tree.order()[tree.place(f)] == f);
  for (int trial = 0; trial < 40; ++trial) {
    PointGroup<kGroupSize> group;
    std::vector<double> expected;
    Vec3 last;
    for (int i = 0; i < kGroupSize; ++i) {
      last = (trial % 2 ? 0.05 : 2.0) * random_point(random) + Vec3(0.5, 0.5, 0.0);
      group.set(i, last);
      double least = 1e300;
      for (const Triangle& t : mesh.faces)
        least = std::min(least,
                         brute_force_distance(last, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
      expected.push_back(least);
    }
    int hint = static_cast<int>(random.next() % 200);
    double squared[kGroupSize];
    tree.nearest(group, squared, hint);
    for (int i = 0; i < kGroupSize; ++i) CHECK(std::sqrt(squared[i]) == Approx(expected[i]).epsilon(1e-9));
    CHECK(std::sqrt(tree.squared_distance(hint, last)) == Approx(expected.back()).epsilon(1e-9));
    int other = tree.descend(last);
    CHECK(std::sqrt(tree.nearest(last, other)) == Approx(expected.back()).epsilon(1e-9));
    CHECK(tree.squared_plane_distance(other, last) <= tree.squared_distance(other, last) * (1 + 1e-9));
  }
  double most = 0.0;
  for (int k = 0; k < 3; ++k)
    most = std::max(most, (mesh.positions[mesh.faces[7][k]] - mesh.positions[mesh.faces[7][(k + 1) % 3]]).norm());
  CHECK(tree.size(tree.place(7)) == Approx(most));
}

TEST_CASE("between parallel planes every sample is as far, and of a few samples none is worth more") {
  const Mesh lower = shapes::grid(8, 8), upper = shapes::grid(8, 8, 0.25);
  const TriangleTree from(lower), to(upper);
  CHECK(sample_density(lower, from, to, 16, 1).empty());  // too few to tell
  DistanceOptions options;
  options.samples = 5000;
  Progress quiet;
  const OneWayDistance found = sampled_distance(lower, from, to, 10.0, options, "there", quiet);
  CHECK(found.rms == Approx(0.25));
  CHECK(found.hausdorff == Approx(0.25));
}

TEST_CASE("samples are worth more where distances vary, and never less than a quarter of their share") {
  const Mesh flat = shapes::grid(16, 16);
  Mesh bumped = flat;
  for (Vec3& p : bumped.positions)
    if (p.x() > 12.0) p.z() = 0.5 * std::sin(5.0 * p.x() + 3.0 * p.y());
  const TriangleTree from(flat), to(bumped);
  const std::vector<float> density = sample_density(flat, from, to, 40000, 3);
  REQUIRE(density.size() == flat.faces.size());
  double mean = 0.0, there = 0.0, elsewhere = 0.0;
  int count = 0;
  for (std::size_t place = 0; place < density.size(); ++place) {
    CHECK(density[place] >= 0.999f * kLeastDensity);
    mean += density[place] / density.size();
    const double x = flat.positions[flat.faces[from.order()[place]][0]].x();
    (x > 12.0 ? there : elsewhere) += density[place];
    count += x > 12.0;
  }
  CHECK(mean == Approx(1.0).epsilon(1e-4));
  CHECK(there / count > 2.0 * elsewhere / (static_cast<int>(density.size()) - count));
}
