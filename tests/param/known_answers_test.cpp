#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "metrics/distortion.h"
#include "param/parameterize.h"
#include "param/removal/removal_cost.h"

using namespace gsp;

namespace {

// So few that no edge of the shapes below is long for the patches: pieces of split edges are so alike that removals
// tie, and rounding decides between them.
constexpr int kBaseVertices = 24;

/// Without a symmetry or an even spot, where two removals could cost the same.
Mesh uneven() {
  Mesh mesh = shapes::bumpy_sphere(4);
  Random random(11);
  for (Vec3& p : mesh.positions) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    p += 0.01 * Vec3(x, y, z);
  }
  return mesh;
}

ParameterizeResult made(const Mesh& mesh, Objective objective) {
  ParameterizeOptions options;
  options.objective = objective;
  options.base_vertices = kBaseVertices;
  Progress progress;
  ParameterizeResult result = parameterize(mesh, options, progress);
  REQUIRE(check_map(result.map).valid());
  return result;
}

template <class Change>
Mesh changed(Mesh mesh, Change&& change) {
  for (Vec3& p : mesh.positions) p = change(p);
  return mesh;
}

/// Area that each of the first faces has in its chart, which no numbering of charts and their corners changes.
std::vector<double> areas(const Parameterization& map, int faces) {
  std::vector<double> area;
  for (int f = 0; f < faces; ++f)
    area.push_back(chart_area(map.face_corners[f][0], map.face_corners[f][1], map.face_corners[f][2]));
  return area;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

std::vector<int> shuffled(int n, std::uint64_t seed) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  Random random(seed);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random.next() % (i + 1)]);
  return order;
}

double stretch(const Parameterization& map) { return distortion(map).l2_stretch; }

/// Whether two simplifications made the same removals, while stars have at most RemovalCost::kSamples points, which are
/// all priced; of larger ones a part is, by their numbers.
void check_same_costs(const std::vector<OmegaRecord>& a, const std::vector<OmegaRecord>& b) {
  constexpr int kSmallStars = 625;  // vertices left, of the surfaces below
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; a[i].remaining_vertices > kSmallStars; ++i)
    REQUIRE(a[i].omega() == Approx(b[i].omega()).epsilon(1e-9));
}

}  // namespace

TEST_CASE("a surface that is moved, turned or scaled gets the same map", "[slow]") {
  const Mesh mesh = uneven();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Mesh moved = changed(mesh, [&](const Vec3& p) -> Vec3 { return 300.0 * (turn * p) + Vec3(10, -20, 5); });
  const Mesh doubled = changed(mesh, [](const Vec3& p) -> Vec3 { return 2.0 * p; });
  for (Objective objective : {Objective::Distortion, Objective::Linear}) {
    const Parameterization map = made(mesh, objective).map, other = made(moved, objective).map;
    CHECK(map.base.vertices == other.base.vertices);
    CHECK(farthest(areas(map, mesh.face_count()), areas(other, mesh.face_count())) < 1e-9);
    CHECK(made(doubled, objective).map.position == map.position);
  }
}

TEST_CASE("mirrored, renumbered and refined surfaces get maps as good, the first two over the same removals",
          "[slow]") {
  const Mesh mesh = uneven();
  Mesh mirrored = changed(mesh, [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); });
  for (Triangle& t : mirrored.faces) std::swap(t[1], t[2]);
  const std::vector<int> vertex = shuffled(mesh.vertex_count(), 1), face = shuffled(mesh.face_count(), 2);
  Mesh renumbered = mesh;
  for (int v = 0; v < mesh.vertex_count(); ++v) renumbered.positions[vertex[v]] = mesh.positions[v];
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) renumbered.faces[face[f]][k] = vertex[mesh.faces[f][(k + f) % 3]];

  for (Objective objective : {Objective::Distortion, Objective::Linear}) {
    const ParameterizeResult map = made(mesh, objective), mirror = made(mirrored, objective),
                             other = made(renumbered, objective), fine = made(shapes::quadrisect(mesh), objective);
    check_same_costs(map.omega, mirror.omega);
    check_same_costs(map.omega, other.omega);
    // The linear solution jumps with the corners: it starves long limbs or does not.
    if (objective == Objective::Linear) continue;
    for (const ParameterizeResult* same : {&mirror, &other, &fine})
      CHECK(stretch(same->map) == Approx(stretch(map.map)).epsilon(0.1));
  }
}
