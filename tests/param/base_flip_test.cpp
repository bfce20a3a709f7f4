#include "param/corners/base_edge_flip.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/atlas/stretch.h"
#include "param/corners/choose_base_flips.h"
#include "param/energy/lower_distortion.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

std::vector<int> all_edges(const Atlas& atlas) {
  std::vector<int> edges(atlas.surface->edge_count());
  std::iota(edges.begin(), edges.end(), 0);
  return edges;
}

bool flip_alone(Atlas& atlas, const FlipSite& site) {
  std::vector<int> inside;
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v)
    if (atlas.corner[v] < 0 && (atlas.patch[v] == site.faces[0] || atlas.patch[v] == site.faces[1]))
      inside.push_back(v);
  const auto ways = changed_ways(atlas, site, all_edges(atlas));
  return ways && flip(atlas, site, inside, *ways);
}

/// Squared length of every edge's image.
std::vector<double> lengths(const Atlas& atlas) {
  std::vector<double> squares;
  for (int f = 0; f < atlas.surface->mesh.face_count(); ++f) {
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    for (int k = 0; k < 3; ++k) squares.push_back(std::norm(z[(k + 1) % 3] - z[k]));
  }
  return squares;
}

double signed_area(const Atlas& atlas) {
  double sum = 0.0;
  for (int f = 0; f < atlas.surface->mesh.face_count(); ++f) {
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    sum += chart_area(z[0], z[1], z[2]);
  }
  return sum;
}

void check_base(const Atlas& atlas) {
  BaseComplex connected = atlas.base;
  connected.connect();
  CHECK(connected.twins == atlas.base.twins);
  const std::vector<BaseFan> fans = base_fans(atlas.base);
  for (std::size_t b = 0; b < fans.size(); ++b) {
    CHECK(fans[b].boundary == atlas.fans[b].boundary);
    CHECK(fans[b].valence() == atlas.fans[b].valence());
  }
}

}  // namespace

TEST_CASE("a flip keeps the area and the ways of all edges, and a second one takes it back") {
  const Mesh bases[] = {shapes::icosahedron(), shapes::octahedron(), shapes::grid(3, 3)};
  for (const Mesh& base : bases) {
    const Atlas start = atlas_of(exact_maps::quadrisected(base, 3));
    int flipped = 0;
    for (int h = 0; h < static_cast<int>(start.base.twins.size()); ++h) {
      INFO("half-edge " << h << " of a base of " << base.face_count() << " faces");
      const auto site = flip_site(start, h);
      if (!site) continue;
      Atlas atlas = start;
      REQUIRE(flip_alone(atlas, *site));
      ++flipped;
      check_base(atlas);
      CHECK(atlas.broken_faces() == 0);
      CHECK(signed_area(atlas) == Approx(signed_area(start)));
      CHECK(atlas.fans[site->corners[0]].valence() == start.fans[site->corners[0]].valence() - 1);
      CHECK(atlas.fans[site->corners[2]].valence() == start.fans[site->corners[2]].valence() + 1);
      // The new edge runs from d to c in the first face.
      const auto back = flip_site(atlas, 3 * site->faces[0] + 2);
      if (start.fans[site->corners[0]].boundary && start.fans[site->corners[1]].boundary) {
        CHECK_FALSE(back);  // the old edge joined two boundary vertices
        continue;
      }
      REQUIRE(back);
      CHECK(back->corners ==
            std::array<int, 4>{site->corners[3], site->corners[2], site->corners[0], site->corners[1]});
      REQUIRE(flip_alone(atlas, *back));
      check_base(atlas);
      const std::vector<double> before = lengths(start), after = lengths(atlas);
      double largest = 0.0;
      for (std::size_t i = 0; i < before.size(); ++i) largest = std::max(largest, std::abs(after[i] - before[i]));
      CHECK(largest < 1e-12);
    }
    CHECK(flipped > 0);
  }
}

TEST_CASE("edges between patch corners along base edges follow a flip, but for one along the edge that is flipped") {
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 0);
  Atlas coarse = atlas_of(map);
  CHECK_FALSE(flip_alone(coarse, *flip_site(coarse, 0)));

  // A vertex in the middle of the first base edge.
  const int middle = map.surface.vertex_count();
  map.surface.positions.push_back(
      0.5 * (map.surface.positions[map.surface.faces[0][0]] + map.surface.positions[map.surface.faces[0][1]]));
  map.patch.push_back(0);
  map.position.push_back(0.5 * (map.face_corners[0][0] + map.face_corners[0][1]));
  for (int h : {0, map.base.twins[0]}) {
    const int f = h / 3, k = h % 3, next = (k + 1) % 3;
    Triangle piece = map.surface.faces[f];
    auto corners = map.face_corners[f];
    const Complex at = 0.5 * (corners[k] + corners[next]);
    map.surface.faces[f][next] = piece[k] = middle;
    map.face_corners[f][next] = corners[k] = at;
    map.surface.faces.push_back(piece);
    map.face_corners.push_back(corners);
    map.face_chart.push_back(f);
  }
  REQUIRE(check_map(map).valid());
  const Atlas start = atlas_of(map);
  Atlas atlas = start;
  const auto site = flip_site(atlas, 0);
  REQUIRE(site);
  REQUIRE(flip_alone(atlas, *site));
  check_base(atlas);
  CHECK(find_folds(atlas).none());
  CHECK(check_map(atlas.finish({})).valid());
  CHECK(lengths(atlas) != lengths(start));
}

TEST_CASE("edges that the base needs are not flipped") {
  const auto sites = [](const Mesh& base) {
    const Atlas atlas = atlas_of(exact_maps::quadrisected(base, 1));
    int count = 0;
    for (int h = 0; h < static_cast<int>(atlas.base.twins.size()); ++h) count += flip_site(atlas, h).has_value();
    return count;
  };
  CHECK(sites(shapes::tetrahedron()) == 0);  // each corner has three patches, and all are joined
  CHECK(sites(shapes::grid(1, 1)) == 0);     // the new edge would join two boundary vertices
  CHECK(sites(shapes::icosahedron()) == 60);
}

TEST_CASE("an edge that was flipped for the worse is flipped back, and the map is as good as before") {
  Progress progress;
  Mesh sphere = exact_maps::quadrisected(shapes::icosahedron(), 3).surface;
  for (Vec3& p : sphere.positions) p.normalize();
  Parameterization map = exact_maps::quadrisected(shapes::icosahedron(), 3);
  map.surface = sphere;
  Atlas atlas = atlas_of(map);
  REQUIRE(lower_distortion(atlas, 1e-4, progress));
  const double best = l2_stretch(atlas);
  CHECK(flip_base_edges(atlas, progress) == 0);

  for (int h : {0, 10, 31}) {
    Atlas worse = atlas;
    const auto site = flip_site(worse, h);
    REQUIRE(site);
    REQUIRE(flip_alone(worse, *site));
    REQUIRE(find_folds(worse).none());
    REQUIRE(lower_distortion(worse, 1e-4, progress));
    CHECK(l2_stretch(worse) > 1.02 * best);
    CHECK(flip_base_edges(worse, progress) == 1);
    CHECK(worse.broken_faces() == 0);
    CHECK(find_folds(worse).none());
    REQUIRE(lower_distortion(worse, 1e-4, progress));
    CHECK(l2_stretch(worse) == Approx(best).epsilon(1e-3));
    CHECK(check_map(worse.finish({})).valid());
  }
}
