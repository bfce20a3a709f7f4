#include "metrics/surface_distance.h"

#include <catch2/catch.hpp>

#include <limits>

#include <Eigen/Geometry>

#include "mesh/shapes.h"
#include "tests/by_threads.h"
#include "tests/cause_of.h"
#include "tests/metrics/brute_force.h"

using namespace gsp;

namespace {
SurfaceDistance measure(const Mesh& a, const Mesh& b, std::size_t samples = 100000, std::uint64_t seed = 1) {
  Progress silent;
  return surface_distance(a, b, {samples, seed}, silent);
}

Mesh moved(Mesh mesh, const Eigen::Affine3d& motion) {
  for (Vec3& p : mesh.positions) p = motion * p;
  return mesh;
}

bool same_bits(const OneWayDistance& a, const OneWayDistance& b) {
  return a.mean == b.mean && a.rms == b.rms && a.hausdorff == b.hausdorff &&
         a.rms_standard_error == b.rms_standard_error;
}
}  // namespace

TEST_CASE("the tree finds the nearest point of a soup, from any hint, near and far") {
  for (int count : {1, 3, 4, 5, 17, 500}) {
    const Mesh soup = random_soup(count, count);
    const SurfaceTree tree(soup);
    Random random(11);
    int running = -1;
    for (int i = 0; i < 400; ++i) {
      const Vec3 p = (i % 4 == 0 ? 1000.0 : 1.5) * random_point(random);
      const double expected = brute_force_distance(p, soup);
      int cold = -1, far = static_cast<int>(random.next() % count);
      const double distance = std::sqrt(tree.squared_distance(p, cold));
      CHECK(distance == Approx(expected).epsilon(1e-12));
      CHECK(tree.squared_distance(p, far) == tree.squared_distance(p, running));
      const Triangle& t = soup.faces[far];
      CHECK(brute_force_distance(p, soup.positions[t[0]], soup.positions[t[1]], soup.positions[t[2]]) ==
            Approx(expected).epsilon(1e-12));
    }
  }
}

TEST_CASE("a small surface far from the origin and points at enormous distances are still exact") {
  Mesh sphere = shapes::sphere(2, 1e-3);
  const Vec3 offset(1e5, -2e5, 3e5);
  for (Vec3& p : sphere.positions) p += offset;
  const SurfaceTree tree(sphere);
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = offset + 2e-3 * random_point(random);
    int hint = -1;
    CHECK(std::sqrt(tree.squared_distance(p, hint)) == Approx(brute_force_distance(p, sphere)).margin(1e-9));
  }
  for (double far : {1e10, 1e20, 1e100}) {
    int hint = -1;
    CHECK(std::sqrt(tree.squared_distance(Vec3(far, 0, 0), hint)) == Approx(far).epsilon(1e-4));
  }
}

TEST_CASE("offset planes are their offset apart") {
  for (double height : {1e-6, 0.25, 3.0}) {
    const SurfaceDistance d = measure(shapes::grid(8, 8, 0.0), shapes::grid(5, 8, height), 20000);
    CHECK(d.backward.rms == Approx(height).epsilon(1e-12));
    CHECK(d.backward.mean == Approx(height).epsilon(1e-12));
    CHECK(d.backward.hausdorff == Approx(height).epsilon(1e-12));
    CHECK(d.backward.rms_standard_error < 1e-12 * height);
  }
}

TEST_CASE("a plane beside a shorter one: mean, RMS and maximum by integration") {
  // Of [0,8]x[0,1] against [0,4]x[0,1], half lies over it; over the rest the distance grows from 0 to 4.
  const SurfaceDistance d = measure(shapes::grid(8, 1), shapes::grid(4, 1), 200000);
  CHECK(d.forward.mean == Approx(1.0).epsilon(1e-5));
  CHECK(d.forward.rms == Approx(std::sqrt(8.0 / 3.0)).epsilon(1e-5));
  CHECK(d.forward.hausdorff == Approx(4.0).epsilon(1e-3));
  CHECK(d.backward.rms < 1e-12);
  CHECK(d.rms() == d.forward.rms);
  CHECK(d.diagonal == Approx(std::sqrt(65.0)));
  CHECK(d.psnr_db() == Approx(20.0 * std::log10(std::sqrt(65.0) / std::sqrt(8.0 / 3.0))).epsilon(1e-5));
}

TEST_CASE("concentric spheres") {
  const SurfaceDistance d = measure(shapes::sphere(5, 1.0), shapes::sphere(5, 1.25), 50000);
  // The polyhedra are similar, so the distance lies between those of the inscribed and circumscribed spheres.
  CHECK(d.forward.rms == Approx(0.25).epsilon(2e-3));
  CHECK(d.backward.rms == Approx(0.25).epsilon(2e-3));
  CHECK(d.hausdorff() <= 0.25 + 1e-12);
  CHECK(d.forward.rms_standard_error < 1e-4);
}

TEST_CASE("equal surfaces are at no distance") {
  const Mesh torus = shapes::torus(40, 20);
  const SurfaceDistance d = measure(torus, torus, 20000);
  CHECK(d.rms() < 1e-15 * d.diagonal);
  CHECK(d.psnr_db() > 290.0);
}

TEST_CASE("swapping the surfaces swaps the directions, bit for bit") {
  const Mesh a = shapes::torus(30, 12), b = shapes::torus(25, 14);
  const SurfaceDistance ab = measure(a, b, 30000), ba = measure(b, a, 30000);
  CHECK(same_bits(ab.forward, ba.backward));
  CHECK(same_bits(ab.backward, ba.forward));
}

TEST_CASE("rigid motion and scale leave the relative distance as it is, within its standard error") {
  const Mesh a = shapes::sphere(3), b = shapes::torus(30, 12, 0.8, 0.3);
  const SurfaceDistance plain = measure(a, b);
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translate(Vec3(3, -40, 7)).rotate(Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized())).scale(17.0);
  const SurfaceDistance other = measure(moved(a, motion), moved(b, motion));
  CHECK(std::abs(other.forward.rms / 17.0 - plain.forward.rms) < 6.0 * plain.forward.rms_standard_error);
  CHECK(std::abs(other.backward.rms / 17.0 - plain.backward.rms) < 6.0 * plain.backward.rms_standard_error);
}

TEST_CASE("the standard error covers what other seeds give") {
  const Mesh a = shapes::sphere(3), b = shapes::torus(30, 12, 0.8, 0.3);
  double sum = 0.0, squares = 0.0, error = 0.0;
  const int seeds = 40;
  for (int seed = 1; seed <= seeds; ++seed) {
    const OneWayDistance d = measure(a, b, 3000, seed).forward;
    sum += d.rms;
    squares += d.rms * d.rms;
    error += d.rms_standard_error / seeds;
  }
  const double deviation = std::sqrt(squares / seeds - sum / seeds * (sum / seeds));
  // Pairs of strata overestimate the error, since the distance also changes from one to the next; but not grossly.
  CHECK(deviation < 1.3 * error);
  CHECK(deviation > 0.2 * error);
}

TEST_CASE("isolated vertices and degenerate faces change nothing") {
  const Mesh a = shapes::sphere(2), b = shapes::torus(12, 8);
  Mesh dirty = a;
  dirty.positions.push_back(Vec3(100, 100, 100));
  const int from = a.faces[9][0], to = a.faces[9][1];
  dirty.faces.push_back({from, from, to});
  dirty.faces.push_back({7, 7, 7});
  const SurfaceDistance clean = measure(a, b, 50000), d = measure(dirty, b, 50000);
  CHECK(d.diagonal == clean.diagonal);
  CHECK(d.forward.rms == Approx(clean.forward.rms).epsilon(1e-3));
  CHECK(d.backward.rms == Approx(clean.backward.rms).epsilon(1e-3));
}

TEST_CASE("one and two threads give the same bits") {
  const Mesh a = shapes::torus(80, 40), b = shapes::torus(60, 30);
  const auto [one, two] = by_one_and_two_threads([&] { return measure(a, b, 50001); });
  CHECK(same_bits(one.forward, two.forward));
  CHECK(same_bits(one.backward, two.backward));
}

TEST_CASE("a tree at hand gives the same as building it") {
  const Mesh a = shapes::sphere(2), b = shapes::torus(12, 8);
  Progress silent;
  const SurfaceTree tree(a);
  CHECK(same_bits(surface_distance(a, tree, b, {5000, 3}, silent).backward, measure(a, b, 5000, 3).backward));
}

TEST_CASE("a tree in the order of another finds the same nearest points as one of its own") {
  const Mesh ball = shapes::bumpy_sphere(4);
  Mesh moved = ball, shuffled = ball;
  for (Vec3& p : moved.positions)
    p = Vec3(3.0 * p.x() + 5.0, p.y() - p.z(), 0.2 * p.z() + 0.1 * std::sin(20.0 * p.x()));
  for (std::size_t f = 0; f < shuffled.faces.size(); ++f) std::swap(shuffled.faces[f], shuffled.faces[f * 7 % 500]);
  const SurfaceTree like(ball);
  const std::vector<Vec3> points = shapes::torus(40, 30).positions;
  for (const Mesh& mesh : {ball, moved, shuffled}) {
    const SurfaceTree own(mesh), in_that_order(mesh, like);
    for (const Vec3& p : points) {
      int hint = -1, other_hint = -1;
      CHECK(in_that_order.squared_distance(p, hint) == own.squared_distance(p, other_hint));
    }
  }
  CHECK(cause_of([&] { SurfaceTree(shapes::sphere(2), like); }) == Cause::BadOption);
  moved.positions.front().x() = std::numeric_limits<double>::quiet_NaN();
  CHECK(cause_of([&] { SurfaceTree(moved, like); }) == Cause::NonFinite);
}

TEST_CASE("refusals have a cause") {
  const Mesh sphere = shapes::sphere(1);
  Mesh empty, line = sphere;
  empty.positions.push_back(Vec3::Zero());
  line.faces = {{0, 1, 1}};
  const auto cause = [](const auto& call) {
    try {
      call();
    } catch (const Error& e) {
      return e.cause();
    }
    return Cause::Internal;
  };
  CHECK(cause([&] { measure(sphere, empty); }) == Cause::NoFaces);
  CHECK(cause([&] { measure(empty, sphere); }) == Cause::NoFaces);
  CHECK(cause([&] { measure(line, sphere); }) == Cause::NoFaces);
  for (double value : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Mesh wild = sphere;
    wild.positions[3].y() = value;
    CHECK(cause([&] { measure(sphere, wild); }) == Cause::NonFinite);
  }
  CHECK(cause([&] { measure(sphere, sphere, 0); }) == Cause::BadOption);
  Progress cancelling([](const std::string&, double) { return false; });
  CHECK(cause([&] { surface_distance(sphere, sphere, {1000, 1}, cancelling); }) == Cause::Cancelled);
}

TEST_CASE("the 95% quantile of a distance that grows linearly is known") {
  // Half of [0,8]x[0,1] lies over [0,4]x[0,1]; over the rest the distance is uniform in [0, 4]: 5% of all is
  // beyond 3.6.
  const SurfaceDistance d = measure(shapes::grid(8, 1), shapes::grid(4, 1), 200000);
  CHECK(d.forward.quantile95 == Approx(3.6).epsilon(1e-3));
  CHECK(d.quantile95() == d.forward.quantile95);
  CHECK(measure(shapes::grid(8, 8), shapes::grid(8, 8, 0.5)).quantile95() == Approx(0.5).epsilon(3e-4));
}

TEST_CASE("samples where the distance varies: no bias, and a small part of the error of even ones") {
  // A far spike on a fine flat grid holds nearly all of the mean square.
  Mesh spiked = shapes::grid(60, 60);
  spiked.positions[30 * 61 + 30].z() = 2.0;
  const Mesh flat = shapes::grid(60, 60);
  // Six faces of area A/6 in projection around the spike, each a linear height over its own tilted area:
  // the mean of (2t)² over a face with t linear from 0 at two corners to 1 at the third is 4/6, and the nearest
  // point of the plane is straight below.
  double spike_area = 0.0;
  for (int f = 0; f < spiked.face_count(); ++f)
    for (int v : spiked.faces[f])
      if (v == 30 * 61 + 30) spike_area += face_area(spiked, f);
  const double expected = std::sqrt(spike_area * 4.0 / 6.0 / surface_area(spiked));
  double sum = 0.0, error = 0.0;
  const int seeds = 20;
  for (int seed = 1; seed <= seeds; ++seed) {
    const OneWayDistance d = measure(spiked, flat, 40000, seed).forward;
    sum += d.rms / seeds;
    error += d.rms_standard_error / seeds;
    CHECK(std::abs(d.rms - expected) < 5.0 * d.rms_standard_error);
  }
  CHECK(std::abs(sum - expected) < 5.0 * error / std::sqrt(seeds));
  CHECK(error < 2e-3 * expected);
}

TEST_CASE("a spike of a few faces is found whatever the seed, and the standard error knows of it") {
  // One vertex in 10,000, so that an eighth of the samples would miss its faces more often than not.
  Mesh spiked = shapes::grid(100, 100);
  spiked.positions[50 * 101 + 50].z() = 1.0;
  for (int f = 0; f < 100; ++f) spiked.positions[f].z() = 1e-3;
  const Mesh flat = shapes::grid(100, 100);
  for (int seed = 1; seed <= 8; ++seed) {
    const OneWayDistance d = measure(spiked, flat, 21000, seed).forward,
                         precise = measure(spiked, flat, 2000000, 99).forward;
    CHECK(std::abs(d.rms - precise.rms) < 5.0 * d.rms_standard_error);
    CHECK(d.rms_standard_error < 5e-3 * precise.rms);
  }
}

TEST_CASE("a tolerance is met by adding samples, with the same result as asking for as many") {
  const Mesh a = shapes::sphere(3), b = shapes::torus(30, 12, 0.8, 0.3);
  Progress silent;
  DistanceOptions options{1000, 1};
  options.tolerance_db = 0.002;
  const SurfaceDistance d = surface_distance(a, b, options, silent);
  CHECK(d.forward.samples > 1000);
  CHECK(d.forward.standard_error_db() <= 0.002);
  CHECK(d.backward.standard_error_db() <= 0.002);
  CHECK(same_bits(d.forward, measure(a, b, d.forward.samples).forward));
  options.most_samples = 2000;
  CHECK(surface_distance(a, b, options, silent).forward.samples == 2000);
  CHECK(surface_distance(a, a, options, silent).forward.samples == 1000);
}

TEST_CASE("distances of vertices are those of their points") {
  const Mesh a = shapes::torus(40, 20), b = shapes::sphere(2);
  const std::vector<double> distances = vertex_distances(a, SurfaceTree(b));
  REQUIRE(distances.size() == a.positions.size());
  for (std::size_t v = 0; v < distances.size(); v += 37)
    CHECK(distances[v] == Approx(brute_force_distance(a.positions[v], b)).epsilon(1e-12));
}

TEST_CASE("renumbering vertices and faces leaves the distance as it is, within its standard error") {
  const Mesh a = shapes::sphere(3), b = shapes::torus(30, 12, 0.8, 0.3);
  Mesh other = a;
  const int last = a.vertex_count() - 1;
  std::reverse(other.positions.begin(), other.positions.end());
  std::reverse(other.faces.begin(), other.faces.end());
  for (Triangle& t : other.faces) t = {last - t[1], last - t[2], last - t[0]};
  const SurfaceDistance plain = measure(a, b), renumbered = measure(other, b);
  CHECK(std::abs(renumbered.forward.rms - plain.forward.rms) < 6.0 * plain.forward.rms_standard_error);
  CHECK(std::abs(renumbered.backward.rms - plain.backward.rms) < 6.0 * plain.backward.rms_standard_error);
  CHECK(renumbered.forward.mean == Approx(plain.forward.mean).epsilon(1e-3));
}

TEST_CASE("distances of the size of rounding are none") {
  Mesh a = shapes::sphere(3), b = a;
  for (Vec3& p : b.positions) p *= 1.0 + 1e-15;
  Progress silent;
  CHECK(std::isinf(surface_distance(a, b, {.samples = 1000}, silent).psnr_db()));
  for (Vec3& p : b.positions) p *= 1.0 + 1e-11;
  CHECK(surface_distance(a, b, {.samples = 1000}, silent).psnr_db() > 200.0);
  CHECK_FALSE(surface_distance(a, b, {.samples = 1000}, silent).exact());
}
