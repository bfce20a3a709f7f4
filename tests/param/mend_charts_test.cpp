#include <catch2/catch.hpp>
#include <memory>

#include "mesh/io.h"
#include "mesh/shapes.h"
#include "param/atlas/mend_charts.h"
#include "param/parameterize.h"
#include "param/reinsert/reinsertion.h"
#include "param/simplify/simplify.h"
#include "tests/support/exact_maps.h"
#include "tests/test_meshes.h"

using namespace gsp;

namespace {

/// Gives a vertex the chart of another base face, by the change between them that leaves its numbers as they are.
void misplace(Atlas& atlas, int vertex, int chart) { atlas.change_chart(vertex, chart, Transition{}); }

void check_torn_alone(const MapCheck& check) {
  CHECK(check.flipped_faces == 0);
  CHECK(check.wrong_angle_vertices == 0);
  CHECK(check.misplaced_vertices == 0);
  CHECK(check.mismatched_edges == 0);
  CHECK(check.area_error < 1e-12);
  CHECK(check.torn_edges > 0);
}

void check_same(const Atlas& atlas, const Atlas& right) {
  CHECK(atlas.patch == right.patch);
  CHECK(atlas.position == right.position);
  CHECK(atlas.transition == right.transition);
  CHECK(check_map(atlas.finish({})).valid());
}

/// A map whose faces join the edges of a base face to a vertex in its middle, so that patch corners alone are around
/// it.
Atlas middles(const Mesh& base) {
  Parameterization map = exact_maps::quadrisected(base, 0);
  const std::vector<Triangle> faces = std::exchange(map.surface.faces, {});
  map.face_chart.clear();
  map.face_corners.clear();
  const Complex middle = chart_position(1.0 / 3.0, 1.0 / 3.0);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const Triangle& t = faces[f];
    const int v = map.surface.vertex_count();
    map.surface.positions.push_back(
        (map.surface.positions[t[0]] + map.surface.positions[t[1]] + map.surface.positions[t[2]]) / 3.0);
    map.patch.push_back(f);
    map.position.push_back(middle);
    for (int k = 0; k < 3; ++k) {
      map.surface.faces.push_back({v, t[k], t[(k + 1) % 3]});
      map.face_chart.push_back(f);
      map.face_corners.push_back({middle, kChartCorners[k].value(), kChartCorners[(k + 1) % 3].value()});
    }
  }
  return atlas_of(map);
}

}  // namespace

TEST_CASE("vertices once round a corner of valence 12 from their place go back to it") {
  // Six sectors on, the plane developed about the corner is the same: positions, areas, angles and transitions hold.
  const Atlas right = atlas_of(exact_maps::quadrisected(shapes::sector_disc(12, 0), 3));
  const BaseFan* fan = nullptr;
  for (const BaseFan& f : right.fans)
    if (f.valence() == 12) fan = &f;
  REQUIRE(fan != nullptr);
  Atlas atlas = right;
  int moved = 0;
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v) {
    const auto w = chart_barycentric(atlas.position[v]);
    if (!atlas.is_free(v) || atlas.patch[v] != fan->sector(0).face || std::min({w[0], w[1], w[2]}) < 1e-3) continue;
    const Transition round = fan->develop(6).inverse() * fan->develop(0);
    atlas.change_chart(v, fan->sector(6).face, round);
    ++moved;
  }
  REQUIRE(moved > 10);
  check_torn_alone(check_map(atlas.finish({})));
  CHECK(mend_charts(atlas) == moved);
  check_same(atlas, right);
}

TEST_CASE("vertices with another base face's chart and the same numbers go back, one or many") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::lattice_torus(4, 5), shapes::genus_slab(2, 0)}) {
    const Atlas right = atlas_of(exact_maps::quadrisected(base, 3));
    Atlas atlas = right;
    int moved = 0;
    for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v) {
      const auto w = chart_barycentric(atlas.position[v]);
      if (!atlas.is_free(v) || right.patch[v] % 4 != 0 || std::min({w[0], w[1], w[2]}) < 1e-3) continue;
      misplace(atlas, v, right.patch[v] / 4 % 2 == 0 ? 1 : 3);  // two such groups do not touch
      ++moved;
    }
    REQUIRE(moved > 0);
    check_torn_alone(check_map(atlas.finish({})));
    CHECK(mend_charts(atlas) == moved);
    check_same(atlas, right);
  }
}

TEST_CASE("a vertex between patch corners alone is seen over the edges between them") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::lattice_torus(4, 5), shapes::genus_slab(2, 0)}) {
    const Atlas right = middles(base);
    REQUIRE(check_map(right.finish({})).valid());
    Atlas atlas = right;
    misplace(atlas, base.vertex_count() + 5, 11);
    misplace(atlas, base.vertex_count() + 9, 2);
    check_torn_alone(check_map(atlas.finish({})));
    CHECK(mend_charts(atlas) == 2);
    check_same(atlas, right);
  }
}

TEST_CASE("charts that are right are left to the bit, on base edges and boundaries too") {
  for (const Mesh& base :
       {shapes::tetrahedron(), shapes::octahedron(), shapes::sector_disc(3, 0), shapes::sector_disc(12, 0),
        shapes::grid(2, 3), shapes::twice(shapes::octahedron(), Vec3(5, 0, 0))})
    for (int level = 0; level <= 3; ++level) {
      const Atlas right = atlas_of(exact_maps::quadrisected(base, level));
      Atlas atlas = right;
      CHECK(mend_charts(atlas) == 0);
      check_same(atlas, right);
    }
}

TEST_CASE("vertices put back round corners of high valence are in the charts in which they lie") {
  // Few base vertices and many handles: valences over 30. Some of these maps were torn before they were mended.
  for (const auto& [genus, coarsest] : {std::pair(24, 4), {40, 4}, {40, 700}}) {
    INFO("genus " << genus << ", last level of " << coarsest);
    const auto surface = std::make_shared<const Surface>(shapes::genus_slab(genus, 1));
    ParameterizeOptions options;
    options.base_vertices = 4;
    Progress progress;
    SimplifyResult made = simplify(surface, options, coarsest, progress);
    REQUIRE(!made.finer.empty());
    EditableAtlas map = made.map->coarsened();
    for (; !made.finer.empty(); made.finer.pop_back()) {
      map = *reinsert(made.finer.back(), EditableAtlas(map));
      CHECK(map.atlas.reassign_all() == 0);
      mend_charts(map.atlas);
      CHECK(check_map(map.atlas.finish({})).valid());
      CHECK(mend_charts(map.atlas) == 0);
    }
  }
}

TEST_CASE("a surface of genus 133 is joined at the first try", "[slow]") {
  const std::string folder = shared_meshes();
  if (folder.empty()) return;
  ParameterizeOptions options;
  options.base_vertices = 100;  // fewer than can be reached
  Progress progress;
  std::string notes;
  progress.on_note([&](const std::string& note) { notes += note + "; "; });
  CHECK(check_map(parameterize(read_mesh(folder + "/variety/cheese_8629.ply"), options, progress).map).valid());
  CHECK(notes.find("could not be joined") == std::string::npos);
}
