#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/corners/descend_corners.h"
#include "param/energy/lower_distortion.h"
#include "param/linear/address_space.h"
#include "param/linear/global_system.h"
#include "param/linear/intrinsic_triangulation.h"
#include "param/linear/sparse_solver.h"
#include "param/linear/weights.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

constexpr Weights kAll[] = {Weights::MeanValue, Weights::Cotangent, Weights::Uniform};

std::vector<int> all_faces(const Surface& surface) {
  std::vector<int> faces(surface.mesh.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

/// The exact map of a base onto itself, after its free vertices have been put anywhere.
Atlas scrambled(const Parameterization& map, std::uint64_t seed) {
  Atlas atlas = atlas_of(map);
  Random random(seed);
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v) {
    const double x = random.uniform(), y = random.uniform();
    if (atlas.is_free(v)) atlas.position[v] += Complex(x, y);
  }
  return atlas;
}

void solve(Atlas& atlas, Weights kind) {
  atlas.position = solve_global(atlas, LinearWeights(*atlas.surface, kind), interior_vertices(atlas));
}

double farthest(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// By how much the positions of a map of the icosahedron, `level` times quadrisected, fall short of its 120 symmetries.
double asymmetry(const Parameterization& exact, const Atlas& atlas, int level) {
  const int n = 1 << level;
  // Per vertex of one base triangle, with the sorted weights of its place in the exact map, those that it has now.
  std::map<std::array<int, 3>, std::array<double, 3>> first;
  double worst = 0.0;
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v) {
    if (!atlas.is_free(v)) continue;
    const auto was = chart_barycentric(exact.position[v]), is = chart_barycentric(atlas.position[v]);
    std::array<int, 3> order = {0, 1, 2}, key;
    std::sort(order.begin(), order.end(), [&](int a, int b) { return was[a] < was[b] - 1e-9; });
    std::array<double, 3> now;
    for (int k = 0; k < 3; ++k) {
      key[k] = static_cast<int>(std::lround(n * was[order[k]]));
      now[k] = is[order[k]];
    }
    const auto [at, inserted] = first.emplace(key, now);
    for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(at->second[k] - now[k]));
  }
  return worst;
}

}  // namespace

TEST_CASE(
    "an intrinsic triangulation becomes Delaunay, keeps the angles around its vertices and its transitions closed") {
  const Parameterization exact = exact_maps::quadrisected(shapes::torus(6, 4), 2);
  Atlas atlas = atlas_of(exact);
  IntrinsicTriangulation triangulation(*atlas.surface, all_faces(*atlas.surface));
  auto& halfedges = triangulation.halfedges();
  for (std::size_t h = 0; h < halfedges.size(); ++h) {
    const int e = atlas.surface->edge_of[h];
    halfedges[h].towards = atlas.towards(e, atlas.surface->edge_halfedge[e] == static_cast<int>(h));
  }
  const auto angles = [&] {
    std::vector<double> sum(atlas.patch.size(), 0.0);
    for (int h = 0; h < static_cast<int>(halfedges.size()); ++h)
      sum[halfedges[Halfedges::prev(h)].from] += std::atan2(0.5, triangulation.half_cotangent(h));
    return sum;
  };
  const std::vector<double> before = angles();
  triangulation.make_delaunay(atlas.corner);
  const std::vector<double> after = angles();
  for (std::size_t v = 0; v < before.size(); ++v) CHECK(after[v] == Approx(before[v]).epsilon(1e-9));
  int flipped = 0;
  for (int h = 0; h < static_cast<int>(halfedges.size()); ++h) {
    const auto& side = halfedges[h];
    const int to = halfedges[Halfedges::next(h)].from;
    REQUIRE(halfedges[side.twin].twin == h);
    CHECK(halfedges[side.twin].from == to);
    CHECK(halfedges[side.twin].towards == side.towards.inverse());
    flipped += side.from != atlas.surface->halfedges.from(h);
    const auto is_corner = [&](int v) { return atlas.corner[v] >= 0; };
    if (!is_corner(side.from) || !is_corner(to))
      CHECK(triangulation.half_cotangent(h) + triangulation.half_cotangent(side.twin) > -1e-6);
    const auto &next = halfedges[Halfedges::next(h)], &prev = halfedges[Halfedges::prev(h)];
    if (!is_corner(side.from) && !is_corner(to) && !is_corner(prev.from))
      CHECK((side.towards * next.towards * prev.towards).is_identity());
  }
  CHECK(flipped > 0);
}

TEST_CASE("the Hermitian solver finds what the general one finds") {
  const int n = 40;
  ComplexMatrix a(n, n);
  ComplexVector b(n);
  for (int i = 0; i < n; ++i) {
    a.insert(i, i) = 3.0;
    b[i] = Complex(i, 1.0 - i);
    if (i + 1 < n) {
      a.insert(i, i + 1) = omega_power(i);
      a.insert(i + 1, i) = std::conj(omega_power(i));
    }
  }
  const ComplexMatrix lower = a.triangularView<Eigen::Lower>();
  CHECK((solve_hermitian(lower, b) - solve_sparse(a, b)).norm() < 1e-12 * b.norm());
  CHECK_THROWS(solve_hermitian(ComplexMatrix(-lower), b));
}

TEST_CASE("flat surfaces are mapped by similarities, whatever the weights can know of them") {
  // A lattice torus on itself, all of whose charts continue each other; an irregular disc of six sectors likewise.
  const Parameterization torus = exact_maps::quadrisected(shapes::lattice_torus(4, 5), 2);
  Atlas even = scrambled(torus, 2);
  solve(even, Weights::Uniform);
  CHECK(farthest(even.position, torus.position) < 1e-10);

  const Mesh base = shapes::sector_disc(6, 0);
  Parameterization disc = exact_maps::quadrisected(base, 3);
  exact_maps::jitter(disc, 0.19, 3, 5);
  exact_maps::flatten_onto_base(disc, base);
  for (Weights kind : kAll) {
    Atlas atlas = scrambled(exact_maps::quadrisected(base, 3), 3);
    Mesh moved = atlas.surface->mesh;
    moved.positions = disc.surface.positions;
    atlas.surface = std::make_shared<const Surface>(moved);
    solve(atlas, kind);
    atlas.reassign_all();
    double error = 0.0;
    for (int v = 0; v < moved.vertex_count(); ++v) {
      const auto w = chart_barycentric(atlas.position[v]);
      const Triangle& t = base.faces[atlas.patch[v]];
      const Vec3 there = w[0] * base.positions[t[0]] + w[1] * base.positions[t[1]] + w[2] * base.positions[t[2]];
      error = std::max(error, (there - moved.positions[v]).norm());
    }
    // Uniform weights see the connectivity alone, which is even here.
    if (kind == Weights::Uniform)
      CHECK(error > 1e-3);
    else
      CHECK(error < 1e-9);
  }
}

TEST_CASE("a sphere over the icosahedron is mapped with all the icosahedron's symmetries") {
  constexpr int kLevel = 3;
  Parameterization exact = exact_maps::quadrisected(shapes::icosahedron(), kLevel);
  for (Vec3& p : exact.surface.positions) p.normalize();
  Progress progress;
  for (Weights kind : kAll) {
    Atlas atlas = scrambled(exact, 4);
    solve(atlas, kind);
    CHECK(asymmetry(exact, atlas, kLevel) < 1e-9);
    CHECK(find_folds(atlas).none());
  }
  Atlas atlas = atlas_of(exact);
  REQUIRE(lower_distortion(atlas, 1e-12, progress));
  CHECK(asymmetry(exact, atlas, kLevel) < 1e-6);
}

TEST_CASE("cotangent weights give the map of least Dirichlet energy") {
  Parameterization exact = exact_maps::quadrisected(shapes::octahedron(), 3);
  for (Vec3& p : exact.surface.positions) p = Vec3(p.x(), 0.3 * p.y(), 2.0 * p.z()) / (0.2 + p.norm());
  Atlas atlas = scrambled(exact, 6);
  const LinearWeights weights(*atlas.surface, Weights::Cotangent);
  const auto energy = [&] {
    double sum = 0.0;
    for (const Spring& s : weights.springs(atlas, all_faces(*atlas.surface)))
      sum += s.at_start * std::norm(atlas.position[s.start] - s.to_start.apply(atlas.position[s.end]));
    return sum;
  };
  solve(atlas, Weights::Cotangent);
  const double least = energy();
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    const int v = static_cast<int>(random.next() % atlas.patch.size());
    if (!atlas.is_free(v)) continue;
    const Complex before = atlas.position[v];
    atlas.position[v] += std::polar(1e-3, 6.28 * random.uniform());
    CHECK(energy() > least);
    atlas.position[v] = before;
  }
}

TEST_CASE("corners stay where symmetry wants them, and go back down the energy's gradient when they are pushed off") {
  constexpr int kLevel = 4;
  Parameterization exact = exact_maps::quadrisected(shapes::icosahedron(), kLevel);
  for (Vec3& p : exact.surface.positions) p.normalize();
  Progress progress;
  for (Objective objective : {Objective::Linear, Objective::Distortion}) {
    Atlas atlas = atlas_of(exact);
    const LinearWeights weights(*atlas.surface, Weights::Cotangent);
    const auto settle = [&] {
      if (objective == Objective::Distortion) {
        lower_distortion(atlas, 1e-9, progress);
        return;
      }
      atlas.position = solve_global(atlas, weights, interior_vertices(atlas));
      atlas.reassign_all();
    };
    settle();
    CHECK(descend_corners(atlas, objective, kRelaxationRadius, Folding::Refused) == 0);

    const int first = atlas.base.vertices[0];
    const int pushed = move_corners(atlas, kRelaxationRadius, Folding::Refused, [&](CornerDisc disc, CornerMove& move) {
      if (disc.corner() != first || !disc.collect()) return false;
      int aside = 1;
      for (int i = 2; i < static_cast<int>(disc.vertices().size()); ++i)
        if (std::abs(disc.vertices()[i].disc - 0.12) < std::abs(disc.vertices()[aside].disc - 0.12)) aside = i;
      return disc.draw_to_center(aside) && make_move(disc, aside, move);
    });
    REQUIRE(pushed == 1);
    REQUIRE(atlas.base.vertices[0] != first);
    const auto distance = [&] {
      const auto& p = atlas.surface->mesh.positions;
      return (p[atlas.base.vertices[0]] - p[first]).norm();
    };
    const double before = distance();
    for (int round = 0; round < 8; ++round) {
      settle();
      if (descend_corners(atlas, objective, kRelaxationRadius, Folding::Refused) == 0) break;
    }
    CHECK(atlas.broken_faces() == 0);
    CHECK(find_folds(atlas).none());
    // Edges of the sphere are about 0.07 long.
    CHECK(before > 0.1);
    CHECK(distance() < 0.08);
  }
}

TEST_CASE("a solve leaves the number of threads of OpenBLAS and OpenMP as it found it") {
  const auto call = [](const char* name) { return dlsym(RTLD_DEFAULT, name); };
  const auto blas = reinterpret_cast<int (*)()>(call("openblas_get_num_threads"));
  const auto set_blas = reinterpret_cast<void (*)(int)>(call("openblas_set_num_threads"));
  const auto levels = reinterpret_cast<int (*)()>(call("omp_get_max_active_levels"));
  const auto set_levels = reinterpret_cast<void (*)(int)>(call("omp_set_max_active_levels"));
  if (!blas || !levels) return;  // a build without SuiteSparse
  const int blas_before = blas(), levels_before = levels();
  set_blas(2);
  set_levels(1);
  Eigen::SparseMatrix<double> identity(40, 40);
  identity.setIdentity();
  const Eigen::MatrixX2d right = Eigen::MatrixX2d::Ones(40, 2);
  Eigen::MatrixX2d x;
  CHECK(solve_sparse(identity, right, x));
  CHECK((x == right));
  CholeskySolver cholesky;
  CHECK(cholesky.factorize(identity));
  CHECK((cholesky.solve(right.col(0)) == right.col(0)));
  CHECK(blas() == 2);
  CHECK(levels() == 1);
  set_blas(blas_before);
  set_levels(levels_before);
}

TEST_CASE("address space that no process has is refused, and what there is stays free") {
  CHECK_NOTHROW(require_address_space(1 << 20));
  CHECK_THROWS_AS(require_address_space(std::size_t{1} << 60), std::bad_alloc);
}
