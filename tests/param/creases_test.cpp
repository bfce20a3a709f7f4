#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "cause_of.h"
#include "mesh/error.h"
#include "mesh/features/features.h"
#include "mesh/io.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "param/atlas/split_edges.h"
#include "param/creases/cut_surface.h"
#include "param/creases/feature_budget.h"
#include "param/parameterize.h"
#include "param/simplify/simplify.h"
#include "test_meshes.h"

using namespace gsp;

namespace {

/// The base edges, as pairs of base vertices, on which a vertex lies: all at it for a patch corner.
std::set<std::array<int, 2>> base_edges_at(const Parameterization& map, int v) {
  std::set<std::array<int, 2>> edges;
  const auto w = chart_barycentric(map.position[v]);
  const Triangle& t = map.base.faces[map.patch[v]];
  for (int k = 0; k < 3; ++k)
    if (std::abs(w[k]) < 1e-14) {
      const auto [a, b] = std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]);
      edges.insert({a, b});
    }
  const auto at = std::find(map.base.vertices.begin(), map.base.vertices.end(), v);
  if (at == map.base.vertices.end()) return edges;
  const int b = static_cast<int>(at - map.base.vertices.begin());
  for (const auto& crease : map.base.creases)
    if (crease[0] == b || crease[1] == b) edges.insert(crease);
  return edges;
}

/// Whether an edge of the surface lies on one crease of the base.
bool on_crease(const Parameterization& map, int a, int b) {
  const auto at_a = base_edges_at(map, a), at_b = base_edges_at(map, b);
  return std::any_of(at_a.begin(), at_a.end(), [&](const auto& edge) {
    return at_b.count(edge) > 0 && std::binary_search(map.base.creases.begin(), map.base.creases.end(), edge);
  });
}

/// The features of a map's surface: those of the input, whose edges may have been split.
int features_off_creases(const Parameterization& map, const FeatureEdges& features) {
  std::set<int> on_features;
  for (const auto& [a, b] : features) on_features.insert({a, b});
  int off = 0;
  for (int v : on_features) {
    const auto edges = base_edges_at(map, v);
    off += std::none_of(edges.begin(), edges.end(), [&](const auto& edge) {
      return std::binary_search(map.base.creases.begin(), map.base.creases.end(), edge);
    });
  }
  return off;
}

/// No two base faces on the same vertices, no edge of more than two.
void check_simplicial(const BaseComplex& base, const Mesh& surface) {
  Mesh mesh;
  for (int v : base.vertices) mesh.positions.push_back(surface.positions[v]);
  mesh.faces = base.faces;
  const TopologyReport report = topology_report(mesh);
  CHECK(report.non_manifold_edges.empty());
  CHECK(report.non_manifold_vertices.empty());
  CHECK(report.duplicate_faces.empty());
  CHECK(report.isolated_vertices.empty());
}

ParameterizeResult creased(const Mesh& mesh, int base_vertices, int degrees = kAutoFeatures) {
  ParameterizeOptions options;
  options.base_vertices = base_vertices;
  options.feature_degrees = degrees;
  Progress progress;
  return parameterize(mesh, options, progress);
}

void check_creased(const Mesh& mesh, const ParameterizeResult& result) {
  CHECK(check_map(result.map).valid());
  check_simplicial(result.map.base, result.map.surface);
  CHECK(!result.map.base.creases.empty());
  CHECK(features_off_creases(result.map, result.features.edges) == 0);
  std::set<std::array<int, 2>>
      edges;  // of the map's surface: long ones of the input were split, maybe at a base vertex
  for (const Triangle& t : result.map.surface.faces)
    for (int k = 0; k < 3; ++k) edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  for (const auto& edge : result.features.edges) {
    INFO(edge[0] << ' ' << edge[1]);
    CHECK((edges.count(edge) == 0 || on_crease(result.map, edge[0], edge[1])));
  }
  CHECK(std::equal(mesh.positions.begin(), mesh.positions.end(), result.map.surface.positions.begin()));
}

}  // namespace

TEST_CASE("the seams of a cut surface couple the copies inside curves and hold their corners") {
  const Mesh box = shapes::box(2);
  const CutSurface cut = cut_surface(box, detect_features(box));
  const Seams& seams = cut.surface->seams;
  CHECK(seams.points == 8 + 12 * 3);
  int corners = 0, coupled = 0;
  for (int v = 0; v < cut.surface->mesh.vertex_count(); ++v) {
    corners += seams.is_corner(v);
    if (seams.other_of(v) < 0) continue;
    ++coupled;
    CHECK(seams.other_of(seams.other_of(v)) == v);
    CHECK(cut.whole(v) == cut.whole(seams.other_of(v)));
    CHECK(seams.same(v, seams.other_of(v)));
  }
  CHECK(corners == 3 * 8);
  CHECK(coupled == 2 * 12 * 3);
  CHECK(cut.whole_vertices == box.vertex_count());
}

TEST_CASE("feature edges follow where edges are split") {
  Mesh mesh = shapes::box(0);
  const FeatureEdges features = detect_features(mesh);
  const int own = mesh.vertex_count();
  const LongEdgeSplit split = split_long_edges(mesh, 0.4, 10000);
  const FeatureEdges after = split_features(features, split.ends, own);
  CHECK(after.size() == 12 * 4);
  CHECK(after == detect_features(mesh));
}

TEST_CASE("a curve's vertex goes on both sides at once, and the glued complex stays embedded") {
  for (const auto& [mesh, corners] : {std::pair{shapes::box(3), 8}, {shapes::cylinder(24), 6}, {shapes::lens(4), 4}}) {
    const CutSurface cut = cut_surface(mesh, detect_features(mesh));
    ParameterizeOptions options;
    options.base_vertices = 4;
    Progress progress;
    const SimplifyResult made = simplify(cut.surface, options, coarsest_level(*cut.surface, options), progress);
    const std::vector<int> left = remaining_vertices(*cut.surface, made.removals);
    const Seams& seams = cut.surface->seams;
    CHECK(seams.count_whole(left) == corners);
    for (int v : left)
      if (seams.other_of(v) >= 0) CHECK(std::binary_search(left.begin(), left.end(), seams.other_of(v)));
  }
}

TEST_CASE("the curves of known shapes end as chains of base edges of a valid map") {
  const Mesh box = shapes::box(3);
  const ParameterizeResult on_box = creased(box, 20);
  check_creased(box, on_box);
  CHECK(on_box.features.curves == 12);
  CHECK(on_box.map.base.vertex_count() == 20);
  const Mesh coarse_box = shapes::box(0);
  check_creased(coarse_box, creased(coarse_box, 24));
  const Mesh cylinder = shapes::cylinder(32);
  check_creased(cylinder, creased(cylinder, 16));
  const Mesh lens = shapes::lens(4);
  check_creased(lens, creased(lens, 12));
}

TEST_CASE("the baselines have the creases too, alone as beside others") {
  const Mesh box = shapes::box(3);
  ParameterizeOptions options;
  options.base_vertices = 20;
  options.feature_degrees = kAutoFeatures;
  options.relaxations = 0;
  options.base_edges = BaseEdges::Keep;
  Progress progress;
  const std::vector<Method> methods = {Method::Gsp, Method::Maps, Method::MapsSmoothed, Method::Hybrid};
  const auto together = parameterize_all(box, methods, options, progress);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    INFO(method_name(methods[m]));
    CHECK(together[m].map.base.vertices == together[0].map.base.vertices);
    CHECK(together[m].map.base.creases == together[0].map.base.creases);
    check_creased(box, together[m]);
    options.method = methods[m];
    const ParameterizeResult alone = parameterize(box, options, progress);
    CHECK(alone.map.position == together[m].map.position);
    CHECK(alone.map.face_corners == together[m].map.face_corners);
  }
}

TEST_CASE("a slit that ends inside the surface, and one that ends on its boundary, become creases") {
  const Mesh grid = shapes::grid(16, 16);
  ParameterizeOptions options;
  options.base_vertices = 12;
  options.features.emplace();
  for (int i = 4; i < 12; ++i) options.features->push_back({17 * 8 + i, 17 * 8 + i + 1});
  Progress progress;
  const ParameterizeResult inside = parameterize(grid, options, progress);
  check_creased(grid, inside);
  options.features->clear();
  for (int j = 0; j < 9; ++j) options.features->push_back({17 * j + 8, 17 * (j + 1) + 8});
  const ParameterizeResult open = parameterize(grid, options, progress);
  check_creased(grid, open);
  options.features = FeatureEdges{{0, 1}};  // on the boundary
  CHECK(cause_of([&] { parameterize(grid, options, progress); }) == Cause::Malformed);
}

TEST_CASE("curves for which a base has no room give way") {
  const Mesh box = shapes::box(3);
  const ParameterizeResult result = creased(box, 6);
  CHECK(check_map(result.map).valid());
  CHECK(result.features.given_way > 0);
  CHECK(result.map.base.vertex_count() <= 8);
}

TEST_CASE("a base has room for all features from the size that says so on") {
  const Mesh box = shapes::box(3);
  ParameterizeOptions options;
  const FeatureEdges edges = wanted_features(box, options);
  options.base_vertices = base_for_all(feature_curves(box, edges));
  CHECK(options.base_vertices == 20);  // 8 corners on two fifths of the base
  CHECK(choose_features(box, options).edges == edges);
  --options.base_vertices;
  CHECK(choose_features(box, options).given_way > 0);
  CHECK(base_for_all({}) == 0);
}

TEST_CASE("a surface without features has the same map with them asked for") {
  const Mesh sphere = shapes::bumpy_sphere(3);
  const ParameterizeResult with = creased(sphere, 12), without = creased(sphere, 12, kNoFeatures);
  CHECK(with.map.base.creases.empty());
  CHECK(with.map.face_corners == without.map.face_corners);
  CHECK(with.map.position == without.map.position);
  CHECK(with.map.provenance == without.map.provenance);
}

TEST_CASE("the creases of a mechanical part lie on base edges exactly", "[slow]") {
  const std::string samples = sample_meshes();
  if (samples.empty()) return;
  const Mesh part = read_mesh(samples + "/fandisk.off");
  const ParameterizeResult result = creased(part, 150);
  check_creased(part, result);
  CHECK(result.features.curves == 34);
}
