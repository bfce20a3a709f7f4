#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "cause_of.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/closest_energy.h"
#include "remesh/crease_corners.h"
#include "remesh/displaced/control_fit.h"
#include "remesh/displaced/control_system.h"
#include "remesh/displaced/displacement_fit.h"
#include "remesh/displaced/edge_watch.h"
#include "remesh/displaced/fit_target.h"
#include "remesh/displaced/patch_care.h"
#include "remesh/filters/filter.h"
#include "remesh/lattice_corners.h"
#include "remesh/normal/remesh_domain.h"
#include "remesh/remesh_options.h"
#include "remesh/surface_point.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// Of each vertex of a level the mean of its two ends, or itself: a filter known by its taps.
class Midpoints : public TapFilter<Midpoints> {
 public:
  using TapFilter::TapFilter;
  template <class Take>
  void for_each_tap(Take take) const {
    for (int v = 0; v < level_.vertex_count; ++v) take(v, v, 1.0);
    for (int e = 0; e < level_.edge_count(); ++e)
      for (int end : level_.edges[e]) take(odd(e), end, 0.5);
  }
};

std::vector<Vec3> random_places(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> places(count);
  for (Vec3& p : places)
    for (double& x : p) x = 2.0 * random.uniform() - 1.0;
  return places;
}

/// A square of equal faces in the plane z = 0, as levels, with the positions of the finest.
struct FlatSquare {
  std::vector<SubdivisionLevel> levels = subdivision_levels(9, shapes::grid(2, 2).faces, 2);
  std::vector<Vec3> positions = exact_positions();

  std::vector<Vec3> exact_positions() const {
    std::vector<Vec3> p = shapes::grid(2, 2).positions;
    for (std::size_t l = 0; l + 1 < levels.size(); ++l)
      for (const auto& [a, b] : levels[l].edges) p.push_back((p[a] + p[b]) / 2);
    return p;
  }
};

}  // namespace

TEST_CASE("the corners of a quadrisected face's pieces are where subdivision puts their vertices") {
  constexpr int kLevel = 3;
  const auto levels = subdivision_levels(3, {{0, 1, 2}}, kLevel);
  // Lattice coordinates of the base's corners, and of middles of edges from there on.
  std::vector<std::array<int, 2>> at = {{0, 0}, {1 << kLevel, 0}, {0, 1 << kLevel}};
  for (int l = 0; l < kLevel; ++l)
    for (const auto& [a, b] : levels[l].edges) at.push_back({(at[a][0] + at[b][0]) / 2, (at[a][1] + at[b][1]) / 2});
  for (int f = 0; f < levels[kLevel].face_count(); ++f) {
    const auto corners = lattice_corners(kLevel, f);
    for (int k = 0; k < 3; ++k) CHECK(corners[k] == at[levels[kLevel].faces[f][k]]);
  }
}

TEST_CASE("of several faces the one that holds a point best is taken, then the first") {
  SurfacePoint none, first{3, 0.1, {}}, second{7, 0.1, {}}, better{9, 0.2, {}};
  SurfacePoint flipped{1, 0.3 - SurfacePoint::kFlipped, {}}, near{0, -0.01 - SurfacePoint::kNear, {}};
  CHECK(first.better_than(none));
  CHECK_FALSE(none.better_than(first));
  CHECK_FALSE(none.better_than(none));
  CHECK(first.better_than(second));
  CHECK_FALSE(second.better_than(first));
  CHECK(better.better_than(first));
  CHECK(first.better_than(flipped));
  CHECK(flipped.better_than(near));
  // Weights that rounding left outside are on the border, exactly.
  const auto snapped = snapped_weights({0.5, 0.5 + 1e-16, -1e-16});
  CHECK(snapped[2] == 0.0);
  CHECK(snapped[0] + snapped[1] == Approx(1.0));
  const Mesh mesh = shapes::icosahedron();
  CHECK(position_at(mesh, {4, 1.0, snapped_weights({1e-15, 1.0, -1e-17})}) == mesh.positions[mesh.faces[4][1]]);
  const SurfacePoint beside = on_crease({4, 0.0, {1e-9, 0.25, 0.75 - 1e-9}});
  CHECK(beside.weights[0] == 0.0);
  const Vec3 expected = 0.25 * mesh.positions[mesh.faces[4][1]] + 0.75 * mesh.positions[mesh.faces[4][2]];
  CHECK((position_at(mesh, beside) - expected).norm() < 1e-8);
}

TEST_CASE("a crease has a corner where it turns by more than 34.5 degrees, and nowhere else") {
  // Two fans over a zigzag of three vertices, which is the crease, with corner 1 in the middle.
  for (double degrees : {0.0, 20.0, 34.0, 35.0, 90.0}) {
    const double turn = degrees * std::acos(-1.0) / 180.0;
    const std::vector<Vec3> positions = {
        {-1, 0, 0}, {0, 0, 0}, {std::cos(turn), std::sin(turn), 0}, {0, 2, 0}, {0, -2, 0}};
    const SubdivisionLevel level = base_level(5, {{0, 1, 3}, {1, 2, 3}, {1, 0, 4}, {2, 1, 4}}, Creases{{0, 1}, {1, 2}});
    CHECK(crease_corners(level, 5, positions) == (degrees > 34.5 ? std::vector<int>{1} : std::vector<int>{}));
  }
}

TEST_CASE("a filter's taps and its matrix are the same map") {
  const SubdivisionLevel level = base_level(12, shapes::icosahedron().faces);
  const Midpoints filter(level);
  const std::vector<Vec3> x = random_places(12, 3);
  std::vector<Vec3> y(42, Vec3(1, 1, 1));
  filter.add(x.data(), y.data());
  const SparseMatrix matrix = filter.matrix(42, 12);
  for (int r = 0; r < 42; ++r) {
    Vec3 sum(1, 1, 1);
    for (int c = 0; c < 12; ++c) sum += matrix.coeff(r, c) * x[c];
    CHECK((y[r] - sum).norm() < 1e-15);
  }
  const auto [a, b] = level.edges[7];
  CHECK((y[12 + 7] - Vec3(1, 1, 1) - (x[a] + x[b]) / 2).norm() < 1e-15);
}

TEST_CASE("the energy of samples over a plane is their height, and of springs what the moves differ by") {
  const FlatSquare square;
  const SubdivisionLevel& finest = square.levels.back();
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < finest.face_count(); ++f) {
    const LevelPlace middle{f, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    samples.push_back({middle.at(finest, square.positions) + Vec3(0, 0, 0.1), 1.0, middle});
  }
  const Springs springs{0.5, 0.25, 2.0};
  ClosestEnergy energy(finest, samples, springs, square.positions);
  CHECK(energy.at(square.positions) == Approx(0.01 * finest.face_count()));
  CHECK(energy.of_samples() == Approx(0.01 * finest.face_count()));
  // One inner vertex moved along the plane: its tether and six springs, and samples as far as before.
  const int inner =
      static_cast<int>(std::find(energy.inner().begin(), energy.inner().end(), 1) - energy.inner().begin());
  std::vector<Vec3> moved = square.positions;
  moved[inner].x() += 0.01;
  int springs_at = 0;
  for (const auto& [a, b] : finest.edges) springs_at += a == inner || b == inner;
  CHECK(energy.at(moved) == Approx(0.01 * finest.face_count() + 1e-4 * (0.25 + 0.5 * springs_at)));
  // All moved alike: tethers alone, stronger on the boundary.
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = square.positions[v] + Vec3(0, 0, 0.1);
  const auto on_boundary = static_cast<int>(std::count(energy.inner().begin(), energy.inner().end(), 0));
  CHECK(on_boundary == 32);
  CHECK(energy.at(moved) == Approx(0.01 * (0.25 * moved.size() + 2.0 * on_boundary)));
  CHECK(energy.of_samples() == Approx(0.0).margin(1e-12));
}

TEST_CASE("the linear equations of the nearest places are the energy's slope") {
  const FlatSquare square;
  const SubdivisionLevel& finest = square.levels.back();
  Random random(31);
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < finest.face_count(); ++f) {
    const double u = 0.2 + 0.2 * random.uniform(), v = 0.2 + 0.2 * random.uniform();
    const LevelPlace place{f, {1.0 - u - v, u, v}};
    samples.push_back({place.at(finest, square.positions) + Vec3(0, 0, 0.05 * random.uniform()), 1.0, place});
  }
  std::vector<Vec3> positions = square.positions;
  for (Vec3& p : positions) p.z() += 0.01 * random.uniform();
  ClosestEnergy energy(finest, samples, {0.3, 1e-2, 0.0}, square.positions);
  energy.at(positions);
  const VertexSystem system = energy.linearized(positions);
  constexpr double kStep = 1e-6;
  for (int v = 0; v < finest.vertex_count; v += 5)
    for (int k = 0; k < 3; ++k) {
      std::vector<Vec3> up = positions, down = positions;
      up[v][k] += kStep;
      down[v][k] -= kStep;
      const double slope = (energy.at(up) - energy.at(down)) / (2.0 * kStep);
      CHECK(-2.0 * system.right()[v][k] == Approx(slope).margin(1e-7));
    }
}

TEST_CASE("control points whose limit surface is the target are found again") {
  const auto levels = subdivision_levels(12, shapes::icosahedron().faces, 2);
  const auto finer = subdivision_levels(12, shapes::icosahedron().faces, 3);
  std::vector<Vec3> control = shapes::icosahedron().positions;
  for (std::size_t b = 0; b < control.size(); ++b) control[b] *= 1.0 + 0.05 * static_cast<double>(b % 4);
  const std::vector<Vec3> points = smooth_surface(finer, control).points;
  const FitTarget target{finer.back(), points};
  std::vector<SurfaceSample> samples = target.samples(1);
  const ControlMap map(levels);
  const std::vector<Vec3> found = fit_control(map, levels, target, {0, std::vector<double>(20, 1.0)}, samples);
  // The target is sampled at points of faces that the remesh has in the plane: nearly the same surface.
  double farthest = 0.0;
  for (std::size_t b = 0; b < control.size(); ++b) farthest = std::max(farthest, (found[b] - control[b]).norm());
  CHECK(farthest < 0.02);
  const std::vector<Vec3> by_map = map.points(control), limit = smooth_surface(levels, control).points;
  for (std::size_t v = 0; v < limit.size(); ++v) CHECK((by_map[v] - limit[v]).norm() < 1e-13);
}

TEST_CASE("samples of a target weigh one over each face of the remesh and lie where the map has them") {
  const auto levels = subdivision_levels(12, shapes::icosahedron().faces, 3);
  std::vector<Vec3> positions = shapes::icosahedron().positions;
  for (int l = 0; l < 3; ++l)
    for (const auto& [a, b] : levels[l].edges) positions.push_back((positions[a] + positions[b]) / 2);
  const FitTarget target{levels[3], positions};
  double weight = 0.0;
  for (const SurfaceSample& s : target.samples(2)) {
    weight += s.weight;
    CHECK((s.place.at(levels[1], positions) - s.point).norm() < 1e-14);  // flat: the place is the point
  }
  CHECK(weight == Approx(levels[1].face_count()));
  const std::vector<LevelPlace> places = target.vertex_places(levels[1].vertex_count);
  for (int v = 0; v < levels[1].vertex_count; ++v) CHECK(places[v].at(levels[3], positions) == positions[v]);
  for (double length : longest_edges(levels[2], positions))
    CHECK(length == Approx((positions[levels[0].edges[0][0]] - positions[levels[0].edges[0][1]]).norm() / 4));
  // Inside a face its normal, at a vertex the way to the point.
  const Vec3 above = *target.direction({0, {0.25, 0.25, 0.5}}, Vec3(5, 5, 5));
  for (int k = 0; k < 3; ++k)
    CHECK(above.dot(positions[levels[3].faces[0][k]] - positions[levels[3].faces[0][0]]) == Approx(0.0).margin(1e-12));
  const Vec3 corner = positions[levels[3].faces[0][0]];
  CHECK((*target.direction({0, {1, 0, 0}}, corner + Vec3(0, 0, 2)) - Vec3(0, 0, 1)).norm() < 1e-15);
  CHECK_FALSE(target.direction({0, {1, 0, 0}}, corner));
}

TEST_CASE("a plane pierced along normals is as far as it is lifted, and a fit goes there") {
  const auto levels = subdivision_levels(16, shapes::grid(3, 3).faces, 2);
  const auto finer = subdivision_levels(16, shapes::grid(3, 3).faces, 3);
  const SmoothSurface flat = smooth_surface(levels, shapes::grid(3, 3).positions);
  std::vector<Vec3> lifted = smooth_surface(finer, shapes::grid(3, 3).positions).points;
  for (Vec3& p : lifted) p.z() += 0.05;
  const FitTarget target{finer.back(), lifted};
  const PiercedDisplacements pierced = pierce_target(levels, flat, target);
  CHECK(pierced.missed == 0);
  for (double along : pierced.displacements.along) CHECK(along == Approx(0.05));
  std::vector<SurfaceSample> samples = target.samples(1);
  const std::vector<Vec3> moves = fit_displacements(levels, flat, target, {0.01, 1e-3, 1.0, 10, 10.0, 1e-4}, samples,
                                                    std::vector<Vec3>(flat.points.size(), Vec3::Zero()));
  for (const Vec3& move : moves) CHECK(move.z() == Approx(0.05).epsilon(0.02));
}

TEST_CASE("edges that are watched lie as far from a plane as it is lifted, the more the longer they are drawn") {
  const auto levels = subdivision_levels(16, shapes::grid(3, 3).faces, 1);
  std::vector<Vec3> flat = smooth_surface(levels, shapes::grid(3, 3).positions).points, lifted = flat;
  for (Vec3& p : lifted) p.z() += 0.5;
  const FitTarget target{levels.back(), flat};
  const int inner =
      static_cast<int>(std::find(levels[1].creased.begin(), levels[1].creased.end(), 0) - levels[1].creased.begin());
  EdgeWatch watch(levels.back(), flat, target, {inner});
  watch.find_places(flat);
  CHECK(watch.energy() < 1e-25);
  watch.find_places(lifted);
  CHECK(watch.energy() == Approx(10.0 * 0.25));
  // The slope of half the energy: both ends have half of the midpoint's.
  const std::vector<char> free(flat.size(), 1);
  VertexSystem system(levels.back(), free);
  watch.add_to(system);
  for (int v = 0; v < levels[1].vertex_count; ++v) {
    const bool end = v == levels[1].edges[inner][0] || v == levels[1].edges[inner][1];
    CHECK((system.right()[v] - Vec3(0, 0, end ? -0.5 * 10.0 * 0.5 : 0.0)).norm() < 1e-12);
  }
  for (Vec3& p : lifted) p.head<2>() *= 2.0;
  watch.find_places(lifted);
  CHECK(watch.energy() > 3.99 * 10.0 * 0.25);
}

TEST_CASE("what breaks goes farther step by step, and each face ends as it was best") {
  // A strip of 8 triangles of two rows: faces 0 and 7 have no vertex in common.
  const Mesh strip = shapes::grid(4, 1);
  const std::vector<double> areas(8, 0.125);
  PatchCare care(strip.vertex_count(), strip.faces, areas);
  CHECK(care.now() == std::vector<int>(8, 0));
  std::vector<double> errors(8, 1.0);
  CHECK_FALSE(care.learn(errors));
  errors[0] = 100.0;
  PatchCare broken(strip.vertex_count(), strip.faces, areas);
  CHECK(broken.learn(errors));
  CHECK(broken.now()[0] == 1);
  CHECK(broken.now()[7] == 0);
  errors[0] = 60.0;  // better, and not enough
  CHECK(broken.learn(errors));
  CHECK(broken.now()[0] == 2);
  errors[0] = 200.0;  // worse: a step farther all the same
  CHECK(broken.learn(errors));
  CHECK(broken.now()[0] == 3);
  CHECK(broken.learn(errors));  // nothing is left to try: back to the best
  CHECK(broken.now()[0] == 1);
  CHECK_FALSE(broken.learn(errors));
}

TEST_CASE("the faces of a regular remesh are equal triangles of their charts, at every level") {
  const Parameterization map = exact_maps::quadrisected(shapes::octahedron(), 0);
  const auto levels = subdivision_levels(6, map.base.faces, 2);
  RemeshDomain domain(map.base, levels);
  for (int l = 0;; ++l) {
    const double side = std::ldexp(1.0, -l);
    for (int f = 0; f < domain.connectivity().face_count(); ++f) {
      const auto z = domain.corners(f);
      for (int k = 0; k < 3; ++k) CHECK(std::abs(z[(k + 1) % 3] - z[k]) == Approx(side));
      const std::vector<FacePiece> pieces = domain.reach(f);
      CHECK(pieces.front().chart == f >> (2 * l));
      CHECK(pieces.front().motion.is_identity());
    }
    for (int e = 0; e < domain.connectivity().edge_count(); ++e) {
      const SubdivisionLevel& level = domain.connectivity();
      // Over an edge both faces put its ends at the same places.
      const int first = level.edge_faces[e][0], second = level.edge_faces[e][1];
      const auto corner_of = [&](int face, int v) {
        return static_cast<int>(std::find(level.faces[face].begin(), level.faces[face].end(), v) -
                                level.faces[face].begin());
      };
      for (int v : level.edges[e]) {
        const Complex there = domain.across(e, second).apply(domain.corner(first, corner_of(first, v)));
        CHECK(std::abs(there - domain.corner(second, corner_of(second, v))) < 1e-14);
      }
      CHECK((domain.side(e) >= 0) == (first >> (2 * l) != second >> (2 * l)));
    }
    if (l == 2) break;
    std::vector<DomainVertex> middles;
    const SubdivisionLevel& level = domain.connectivity();
    for (int e = 0; e < level.edge_count(); ++e) {
      const int face = level.edge_faces[e][0];
      const std::array<int, 3>& sides = level.face_edges[face];
      const int k = static_cast<int>(std::find(sides.begin(), sides.end(), e) - sides.begin());
      const Complex z = (domain.corner(face, k) + domain.corner(face, (k + 1) % 3)) / 2.0;
      middles.push_back({domain.home(e), domain.side(e), z, domain.home(e), {}});
    }
    domain.refine(std::move(middles));
  }
}

TEST_CASE("remesh options are named and read back, and a file says what they were") {
  for (Positions p : kPositions) CHECK(positions_of(positions_name(p)) == p);
  for (RemeshKind k : kRemeshKinds) CHECK(remesh_kind_of(remesh_kind_name(k)) == k);
  for (Prediction p : kPredictions) CHECK(prediction_of(prediction_name(p)) == p);
  CHECK(cause_of([] { positions_of("Fitted"); }) == Cause::BadOption);
  CHECK(cause_of([] { remesh_kind_of(""); }) == Cause::BadOption);
  CHECK(cause_of([] { prediction_of("loop "); }) == Cause::BadOption);
  RemeshOptions options;
  CHECK(provenance_of(options) == std::vector<std::string>{"kind parametric", "positions fitted"});
  options.kind = RemeshKind::Normal;
  const std::vector<std::string> normal = provenance_of(options);
  CHECK(std::count(normal.begin(), normal.end(), "predict butterfly") == 1);
}
