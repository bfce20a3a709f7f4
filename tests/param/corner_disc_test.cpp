#include "param/corners/corner_disc.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/corners/corner_move.h"
#include "small_maps.h"

using namespace gsp;

namespace {

constexpr int kFine = 3;  // levels: edges of 1/8 in the charts
constexpr double kReach = 0.45;

Atlas fine_atlas(const Mesh& base) { return atlas_of(exact_maps::quadrisected(base, kFine)); }

/// The first base vertex with so many sectors, inside or on the boundary.
int with_valence(const Atlas& atlas, int valence, bool boundary) {
  for (int b = 0; b < atlas.base.vertex_count(); ++b)
    if (atlas.fans[b].valence() == valence && atlas.fans[b].boundary == boundary) return b;
  return -1;
}

/// A base whose vertices have few, six or many patches.
Mesh base_of(int valence) {
  return valence == 3   ? shapes::tetrahedron()
         : valence == 4 ? shapes::octahedron()
         : valence == 5 ? shapes::icosahedron()
         : valence == 6 ? shapes::lattice_torus(4, 3)
                        : shapes::sector_disc(valence, 1);
}

}  // namespace

TEST_CASE("the disc about a corner has the powers and angles of its valence") {
  for (int valence : {3, 4, 5, 6, 8}) {
    const Atlas atlas = fine_atlas(base_of(valence));
    const int b = with_valence(atlas, valence, false);
    REQUIRE(b >= 0);
    CornerDisc disc(atlas, kReach, b);
    REQUIRE(disc.collect());
    CHECK(disc.corner() == b);
    CHECK(disc.power() == Approx(6.0 / valence));
    CHECK(disc.vertices()[0].vertex == b);
    // Places i + jω in eighths, 0 < i, 0 <= j, in each sector; those nearer than 0.45 are inside.
    int inside = 1;
    for (int i = 1; i < 8; ++i)
      for (int j = 0; i + j < 8; ++j) inside += valence * (std::sqrt(i * i + i * j + j * j) < 8 * kReach);
    int found = 0;
    double nearest = 1e300;
    for (const CornerDisc::Vertex& v : disc.vertices()) {
      found += v.inside;
      if (v.vertex == b) continue;
      const int s = atlas.fans[b].find(atlas.patch[v.vertex]);
      REQUIRE(s >= 0);
      const Complex plane = atlas.fans[b].develop(s).apply(atlas.position[v.vertex]);
      CHECK(std::abs(v.disc) == Approx(std::pow(std::abs(plane), 6.0 / valence)));
      CHECK(v.inside == (std::abs(plane) < kReach));
      if (!v.inside) nearest = std::min(nearest, std::abs(v.disc));
      // The angle in the plane, by the sector, and the same in the disc in sixths of a turn for each.
      const double angle = s * kSectorAngle + std::arg(plane * std::polar(1.0, -s * kSectorAngle));
      CHECK(std::abs(std::polar(1.0, angle * 6.0 / valence) - v.disc / std::abs(v.disc)) < 1e-9);
    }
    CHECK(found == inside);
    CHECK(disc.rim() == nearest);
    CHECK(disc.embedded());
  }
}

TEST_CASE("a regular corner's disc is its own solution, and laying it out again changes nothing") {
  for (int valence : {3, 5, 6}) {
    Atlas atlas = fine_atlas(base_of(valence));
    const int b = with_valence(atlas, valence, false);
    CornerDisc disc(atlas, kReach, b);
    REQUIRE(disc.collect());
    // By symmetry the middle stays at the middle under uniform weights; six sectors are all flat, and all stay.
    const std::vector<CornerDisc::Vertex> before = disc.vertices();
    const LinearWeights uniform(*atlas.surface, Weights::Uniform);
    REQUIRE(disc.solve(uniform));
    CHECK(std::abs(disc.vertices()[0].disc) < 1e-12);
    CHECK(disc.nearest_to(0.0) == 0);
    if (valence == 6)
      for (std::size_t i = 0; i < before.size(); ++i) CHECK(std::abs(disc.vertices()[i].disc - before[i].disc) < 1e-12);
    CHECK(disc.embedded());
    REQUIRE(disc.draw_to_center(0));
    CornerMove move;
    move.base_vertex = b;
    REQUIRE(make_move(disc, 0, move));
    CHECK(move.new_corner == b);
    const std::vector<double> lengths = image_lengths(atlas);
    exchange(atlas, move);
    CHECK(atlas.broken_faces() == 0);
    CHECK(free_of_folds(atlas, move));
    CHECK(check_map(atlas.finish({})).valid());
    if (valence == 6) CHECK(largest_change(lengths, image_lengths(atlas)) < 1e-12);
  }
}

TEST_CASE("a corner moved to its neighbour lies there, and a second exchange takes it back bit for bit") {
  for (int valence : {4, 5, 6, 8}) {
    Atlas atlas = fine_atlas(base_of(valence));
    const int b = with_valence(atlas, valence, false), old_corner = atlas.base.vertices[b];
    const Atlas before = atlas;
    CornerDisc disc(atlas, kReach, b);
    REQUIRE(disc.collect());
    const int next = disc.nearest_to(std::pow(0.125, disc.power()));  // the neighbour on the first sector's side
    REQUIRE(next > 0);
    REQUIRE(disc.draw_to_center(next));
    CHECK(disc.vertices()[next].disc == 0.0);
    CHECK(disc.embedded());
    CHECK(disc.upright_in_plane(next));
    CornerMove move;
    move.base_vertex = b;
    REQUIRE(make_move(disc, next, move));
    const int new_corner = move.new_corner;
    CHECK(new_corner != old_corner);
    exchange(atlas, move);
    CHECK(atlas.base.vertices[b] == new_corner);
    CHECK(atlas.corner[new_corner] == b);
    CHECK(atlas.corner[old_corner] == -1);
    CHECK(free_of_folds(atlas, move));
    CHECK(find_folds(atlas).none());
    CHECK(check_map(atlas.finish({})).valid());
    exchange(atlas, move);
    CHECK(atlas.base.vertices == before.base.vertices);
    CHECK(atlas.corner == before.corner);
    CHECK(atlas.patch == before.patch);
    CHECK(atlas.position == before.position);
    CHECK(atlas.transition == before.transition);
  }
}

TEST_CASE("a vertex too near the rim cannot become the corner") {
  const Atlas atlas = fine_atlas(shapes::icosahedron());
  CornerDisc disc(atlas, kReach, 0);
  REQUIRE(disc.collect());
  const std::vector<CornerDisc::Vertex> before = disc.vertices();
  int refused = 0;
  for (std::size_t i = 1; i < before.size(); ++i) {
    if (!before[i].inside || std::abs(before[i].disc) <= 0.4 * disc.rim()) continue;
    CHECK_FALSE(disc.draw_to_center(static_cast<int>(i)));
    ++refused;
  }
  CHECK(refused > 0);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(disc.vertices()[i].disc == before[i].disc);
}

TEST_CASE("faces in the plane about a corner are those of the charts") {
  for (int valence : {3, 5, 6, 7}) {
    const Atlas atlas = fine_atlas(base_of(valence));
    const int b = with_valence(atlas, valence, false);
    CornerDisc disc(atlas, kReach, b);
    REQUIRE(disc.collect());
    for (int f : disc.faces()) {
      const auto z = disc.in_plane(f, 0);
      // Equilateral of side 1/8, counter-clockwise; the first that is not the corner on the real axis.
      for (int k = 0; k < 3; ++k) CHECK(std::abs(z[(k + 1) % 3] - z[k]) == Approx(0.125));
      CHECK(chart_area(z[0], z[1], z[2]) > 0.0);
      const int first = atlas.surface->mesh.faces[f][0] == disc.corner() ? 1 : 0;
      CHECK(std::abs(z[first].imag()) < 1e-12);
    }
    CHECK(disc.upright_in_plane(0));
  }
}

TEST_CASE("around a boundary corner the disc is a half one whose sides are straight") {
  const Atlas atlas = fine_atlas(shapes::grid(2, 2));
  for (int b = 0; b < atlas.base.vertex_count(); ++b) {
    if (!atlas.fans[b].boundary) continue;
    const int valence = atlas.fans[b].valence();
    CornerDisc disc(atlas, kReach, b);
    REQUIRE(disc.collect());
    CHECK(disc.power() == Approx(3.0 / valence));
    for (const CornerDisc::Vertex& v : disc.vertices()) {
      CHECK(v.disc.imag() > -1e-12);
      if (v.vertex == disc.corner()) CHECK_FALSE(v.inside);
      if (v.vertex != disc.corner() && atlas.surface->halfedges.boundary_vertex(v.vertex)) {
        CHECK(std::abs(v.disc.imag()) < 1e-12);
        CHECK_FALSE(v.inside);
      }
    }
  }
}
