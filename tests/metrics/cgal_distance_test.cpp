#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <vector>

#include "mesh/io.h"
#include "mesh/parallel.h"
#include "mesh/shapes.h"
#include "metrics/surface_distance.h"

// Our distances against a second opinion that shares nothing with them: CGAL's tree, and for samples a random point in
// each of the k x k equal parts that a face is cut into.

using namespace gsp;

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

struct Reference {
  double mean = 0.0, rms = 0.0;
};

Reference cgal_distance(const Mesh& from, const Mesh& to, double samples) {
  std::vector<Kernel::Triangle_3> triangles;
  for (int f = 0; f < to.face_count(); ++f)
    if (face_area(to, f) > 0.0)
      triangles.emplace_back(point(to.positions[to.faces[f][0]]), point(to.positions[to.faces[f][1]]),
                             point(to.positions[to.faces[f][2]]));
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  tree.accelerate_distance_queries();
  const double total = surface_area(from);
  constexpr std::size_t kGrain = 1024;
  std::vector<Reference> blocks((from.faces.size() + kGrain - 1) / kGrain);
  parallel_for(from.faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::mt19937_64 random(begin);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Reference& block = blocks[begin / kGrain];
    for (std::size_t f = begin; f < end; ++f) {
      const double area = face_area(from, static_cast<int>(f));
      const Triangle& t = from.faces[f];
      const Vec3 &a = from.positions[t[0]], u = from.positions[t[1]] - a, v = from.positions[t[2]] - a;
      const int k = std::max(1, static_cast<int>(std::lround(std::sqrt(samples * area / total))));
      // A point anywhere in the part, mirrored through the part's middle for parts that stand on their heads; at the
      // parts' centroids instead the mean would be off by more than a per cent, since distances have kinks.
      const auto add = [&](int i, int j, bool upright) {
        double x = uniform(random), y = uniform(random);
        if (x + y > 1.0) x = 1.0 - x, y = 1.0 - y;
        const double s = upright ? i + x : i + 1.0 - x, r = upright ? j + y : j + 1.0 - y;
        const double squared = tree.squared_distance(point(a + s / k * u + r / k * v));
        block.mean += area / total / k / k * std::sqrt(squared);
        block.rms += area / total / k / k * squared;
      };
      for (int i = 0; i < k; ++i)
        for (int j = 0; i + j < k; ++j) {
          add(i, j, true);
          if (i + j + 1 < k) add(i, j, false);
        }
    }
  });
  Reference result;
  for (const Reference& block : blocks) {
    result.mean += block.mean;
    result.rms += block.rms;
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

void check_agreement(const Mesh& a, const Mesh& b, double samples, bool print) {
  Progress silent;
  const SurfaceDistance d = surface_distance(a, b, {1000000, 1}, silent);
  const Reference forward = cgal_distance(a, b, samples), backward = cgal_distance(b, a, samples);
  const auto report = [&](const char* name, const OneWayDistance& ours, const Reference& theirs) {
    if (print)
      std::cout << name << ": RMS " << ours.rms << ", CGAL " << theirs.rms << " ("
                << 100.0 * (ours.rms / theirs.rms - 1.0) << "%); mean " << ours.mean << ", CGAL " << theirs.mean << " ("
                << 100.0 * (ours.mean / theirs.mean - 1.0) << "%)\n";
    CHECK(ours.rms == Approx(theirs.rms).epsilon(0.002));
    CHECK(ours.mean == Approx(theirs.mean).epsilon(0.002));
  };
  report("forward", d.forward, forward);
  report("backward", d.backward, backward);
}

}  // namespace

TEST_CASE("mean and RMS agree with CGAL's tree to 0.2%") {
  SECTION("a bumpy sphere and a coarse one") {
    Mesh bumpy = shapes::sphere(5);
    for (Vec3& p : bumpy.positions) p *= 1.0 + 0.05 * std::sin(7.0 * p.x()) * std::cos(5.0 * p.y() + p.z());
    check_agreement(bumpy, shapes::sphere(3), 400000, false);
  }
  SECTION("surfaces with boundaries, of different size") {
    check_agreement(shapes::grid(9, 4), shapes::torus(50, 30), 400000, false);
  }
}

TEST_CASE("the surfaces named by GSP_DISTANCE_A and GSP_DISTANCE_B agree with CGAL's tree to 0.2%", "[slow]") {
  const char *a = std::getenv("GSP_DISTANCE_A"), *b = std::getenv("GSP_DISTANCE_B");
  if (!a || !b) return;
  check_agreement(read_mesh(a), read_mesh(b), 4e6, true);
}
