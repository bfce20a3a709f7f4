#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "mesh/shapes.h"
#include "param/reinsert/reinsertion.h"
#include "param/reinsert/visibility_kernel.h"
#include "param/simplify/simplify.h"
#include "param/stages/valid_map.h"
#include "param_checks.h"

using namespace gsp;

#ifdef NDEBUG
// A map that is nowhere breaks preconditions, which end the builds that check them.
TEST_CASE("a vertex that finds no place is named") {
  const Mesh mesh = shapes::torus(24, 12);
  const auto surface = std::make_shared<const Surface>(mesh);
  ParameterizeOptions options;
  options.base_vertices = 12;
  Progress progress;
  SimplifyResult made = simplify(surface, options, mesh.vertex_count() / 2, progress);
  REQUIRE(made.finer.size() == 1);
  EditableAtlas map = made.map->coarsened();
  // Neither the map nor the surface says where anything is.
  std::fill(map.atlas.position.begin(), map.atlas.position.end(), Complex(std::nan(""), 0.0));
  Mesh nowhere = mesh;
  std::fill(nowhere.positions.begin(), nowhere.positions.end(), Vec3::Constant(std::nan("")));
  made.finer.front().surface = std::make_shared<const Surface>(nowhere);
  std::optional<int> unplaced;
  CHECK_FALSE(reinsert(made.finer.front(), map, &unplaced));
  REQUIRE(unplaced);
  // It is one of those that the level took out, and stands where the surface has it.
  const std::vector<int>& left = made.finer.front().coarse.vertex;
  CHECK(std::find(left.begin(), left.end(), *unplaced) == left.end());
}
#endif

TEST_CASE("a refusal for want of a place names a face of the vertex") {
  const Mesh mesh = shapes::torus(24, 12);
  for (const int unplaced : {0, 17, mesh.vertex_count() - 1}) {
    CAPTURE(unplaced);
    try {
      refuse_map("no map", mesh.positions[unplaced], mesh);
      FAIL("refuse_map returned");
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::InvalidMap);
      REQUIRE(error.place().value_or(Place()).element == Element::Face);
      const Triangle& face = mesh.faces[static_cast<std::size_t>(error.place()->index)];
      CHECK(std::count(face.begin(), face.end(), unplaced) == 1);
    }
  }
  CHECK_THROWS_AS(refuse_map("no map", std::nullopt, mesh), Error);
}

TEST_CASE("vertices put back leave a map free of folds, from whatever level and map") {
  for (Cut& c : cuts()) {
    split_boundary_chords(c.mesh);
    const auto surface = std::make_shared<const Surface>(c.mesh);
    // The least level is the base itself: all holes have patch corners alone around them at first.
    for (int level : {c.mesh.vertex_count() / 2, 3 * c.base_vertices, c.base_vertices}) {
      INFO(c.name << ", level " << level);
      ParameterizeOptions options;
      options.base_vertices = c.base_vertices;
      Progress progress;
      SimplifyResult made = simplify(surface, options, level, progress);
      REQUIRE(!made.finer.empty());
      const std::size_t remaining = remaining_vertices(*surface, made.removals).size();
      std::optional<EditableAtlas> map = made.map->coarsened();
      for (; !made.finer.empty(); made.finer.pop_back()) {
        const RemovalRecord& decimation = made.finer.back();
        const EditableAtlas before = *map;
        map = reinsert(decimation, before);
        REQUIRE(map);
        CHECK(map->atlas.base.faces == before.atlas.base.faces);
        CHECK(map->atlas.reassign_all() == 0);
        check_map_of(map->atlas, decimation.surface->mesh);
      }
      CHECK(map->atlas.base.vertices.size() == remaining);
      CHECK(check_map(map->atlas.finish({})).valid());
    }
  }
}

TEST_CASE("the faces that are put back are the surface's own, corner by corner") {
  const Mesh mesh = shapes::sphere(3);
  ParameterizeOptions options;
  options.base_vertices = 20;
  Progress progress;
  SimplifyResult made = simplify(std::make_shared<const Surface>(mesh), options, 200, progress);
  EditableAtlas map = made.map->coarsened();
  for (; !made.finer.empty(); made.finer.pop_back()) map = *reinsert(made.finer.back(), map);
  const Mesh& made_again = map.atlas.surface->mesh;
  int whole = 0;
  for (int f = 0; f < mesh.face_count(); ++f) whole += made_again.faces[f] == mesh.faces[f];
  const int added = made_again.vertex_count() - mesh.vertex_count();
  REQUIRE(added < mesh.face_count() / 20);
  CHECK(whole >= mesh.face_count() - 2 * added);
}

TEST_CASE("a vertex goes where it sees the border of its hole, and nowhere else") {
  const std::vector<Complex> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(Kernel{square, false}.least_thickness({0.5, 0.5}) == Approx(0.5));
  CHECK(*Kernel{square, false}.place({0.4, 0.6}) == Complex(0.4, 0.6));
  CHECK(Kernel{square, false}.least_thickness(*Kernel{square, false}.place({3.0, 3.0})) > 0.05);
  // From no place can both arms be seen.
  const std::vector<Complex> u{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  CHECK(!Kernel{u, false}.place({1.5, 0.5}));
  // Of an L only the corner's square is left.
  const std::vector<Complex> l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const auto at = Kernel{l, false}.place({2.5, 0.5});
  REQUIRE(at);
  CHECK(std::max(at->real(), at->imag()) < 1.0);
  // Twice around, as about a patch corner of high valence: every triangle is upright, the middle is covered twice.
  std::vector<Complex> twice;
  for (int k = 0; k < 10; ++k) twice.push_back(std::polar(1.0 + 0.01 * k, 0.4 * 3.14159265358979 * k));
  CHECK(Kernel{twice, false}.least_thickness(0.0) <= 0.0);
}

TEST_CASE("a boundary vertex goes onto the boundary between its neighbours") {
  const std::vector<Complex> half{{1, 0}, {0.5, 1}, {-1, 0}};  // the open side runs from the last to the first
  const auto at = Kernel{half, true}.place_on_chord(0.25);
  REQUIRE(at);
  CHECK(std::abs(*at - Complex(-0.5, 0.0)) < 1e-12);
  const std::vector<Complex> hidden{{1, 0}, {1, 1}, {0.2, 1}, {0.2, 0.1}, {-0.2, 0.1}, {-0.2, 1}, {-1, 1}, {-1, 0}};
  CHECK(!Kernel{hidden, true}.place_on_chord(0.5));
}
