#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "cause_of.h"
#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/baselines/relax_patch_pairs.h"
#include "param/corners/corner_move.h"
#include "param/creases/cut_surface.h"
#include "param/creases/glue_map.h"
#include "param/creases/settle_creases.h"
#include "param/options.h"
#include "param/stages/linear_map.h"
#include "param/stages/smoothed_map.h"
#include "small_maps.h"

using namespace gsp;

namespace {

/// Two unit squares side by side, of equal faces, cut apart along x = 1, and the map of each onto itself.
struct CutStrip {
  Parameterization whole = exact_maps::quadrisected(shapes::grid(2, 1), 2);
  CutSurface cut = cut_surface(whole.surface, seam(whole.surface));
  Atlas atlas = own_atlas();

  static FeatureEdges seam(const Mesh& mesh) {
    std::vector<int> on;
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.positions[v].x() == 1.0) on.push_back(v);
    std::sort(on.begin(), on.end(), [&](int a, int b) { return mesh.positions[a].y() < mesh.positions[b].y(); });
    FeatureEdges edges;
    for (std::size_t i = 1; i < on.size(); ++i)
      edges.push_back({std::min(on[i - 1], on[i]), std::max(on[i - 1], on[i])});
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  Atlas own_atlas() const {
    const Mesh& mesh = cut.surface->mesh;
    Parameterization map;
    map.surface = mesh;
    std::map<std::array<int, 3>, int> base_vertex;  // by square, x and y
    std::vector<std::array<Vec3, 3>> corners;
    for (int square : {0, 1})
      for (int half : {0, 1}) {
        const double x = square;
        corners.push_back(half == 0 ? std::array<Vec3, 3>{{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}}
                                    : std::array<Vec3, 3>{{{x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}});
        Triangle face;
        for (int k = 0; k < 3; ++k) {
          const Vec3& p = corners.back()[k];
          const std::array<int, 3> at = {square, static_cast<int>(p.x()), static_cast<int>(p.y())};
          face[k] = base_vertex.try_emplace(at, static_cast<int>(base_vertex.size())).first->second;
        }
        map.base.faces.push_back(face);
      }
    map.base.vertices.assign(base_vertex.size(), -1);
    map.base.connect();
    map.patch.assign(mesh.positions.size(), -1);
    map.position.resize(mesh.positions.size());
    for (const Triangle& t : mesh.faces) {
      const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
      const int square = middle.x() > 1.0, chart = 2 * square + (middle.x() - square + middle.y() > 1.0);
      std::array<Complex, 3> at;
      for (int k = 0; k < 3; ++k) {
        const Vec3 &p = mesh.positions[t[k]], &origin = corners[chart][0];
        const Vec3 a = corners[chart][1] - origin, b = corners[chart][2] - origin;
        const double whole_area = a.cross(b).z();
        const double u = (p - origin).cross(b).z() / whole_area, v = a.cross(p - origin).z() / whole_area;
        at[k] = chart_position(1.0 - u - v, u);
        map.patch[t[k]] = chart;
        map.position[t[k]] = at[k];
        const bool corner = (p.x() == square || p.x() == square + 1) && (p.y() == 0.0 || p.y() == 1.0);
        if (corner)
          map.base.vertices[base_vertex.at({square, static_cast<int>(p.x()), static_cast<int>(p.y())})] = t[k];
      }
      map.face_chart.push_back(chart);
      map.face_corners.push_back(at);
    }
    Atlas made = atlas_of(map);
    made.surface = cut.surface;
    return made;
  }
};

double farthest(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// How far the vertices are from where they lie in a map of the same faces, wherever their charts are.
double off(const Atlas& atlas, const Atlas& exact) {
  return largest_change(image_lengths(exact), image_lengths(atlas));
}

Atlas shaken(const Mesh& base, int level, double amount) {
  Parameterization map = exact_maps::quadrisected(base, level);
  exact_maps::jitter(map, amount, level, 5);
  return atlas_of(map);
}

}  // namespace

TEST_CASE("vertices of a curve that lie by arc length stay, others go there on both sides") {
  const CutStrip strip;
  REQUIRE(check_map(strip.atlas.finish({})).valid());
  Progress quiet;
  Atlas same = strip.atlas;
  REQUIRE(settle_creases(same, quiet));
  CHECK(farthest(same.position, strip.atlas.position) < 1e-12);
  // Each of the three vertices inside the curve is moved along it, its copies to different places.
  Atlas moved = strip.atlas;
  const Seams& seams = strip.cut.surface->seams;
  Random random(3);
  int count = 0;
  for (int v = 0; v < strip.cut.surface->mesh.vertex_count(); ++v) {
    if (seams.other_of(v) < 0) continue;
    ++count;
    const double along = 0.1 * (2.0 * random.uniform() - 1.0);
    // On the curve y runs along the side of the left square's upper triangle, and of the right one's lower triangle.
    const bool left = moved.patch[v] == 1;
    moved.position[v] += left ? Complex(along, 0.0) : along * Complex(kOmegaRe, kOmegaIm);
  }
  CHECK(count == 6);
  REQUIRE(find_folds(moved).none());
  REQUIRE(settle_creases(moved, quiet));
  for (int v = 0; v < strip.cut.surface->mesh.vertex_count(); ++v)
    if (seams.point_of(v) >= 0) CHECK(std::abs(moved.position[v] - strip.atlas.position[v]) < 1e-12);
  CHECK(find_folds(moved).none());
}

TEST_CASE("where nothing was cut nothing settles") {
  Atlas atlas = shaken(shapes::grid(2, 2), 2, 0.1);
  const std::vector<Complex> before = atlas.position;
  Progress quiet;
  CHECK(settle_creases(atlas, quiet));
  CHECK(atlas.position == before);
}

TEST_CASE("a map of a cut strip glued together is one of the whole, with the cut as its crease") {
  const CutStrip strip;
  const Parameterization glued = glue_map(strip.atlas.finish({}), strip.cut);
  CHECK(check_map(glued).valid());
  const Mesh& whole = strip.whole.surface;
  const int copies = static_cast<int>(strip.cut.original.size());
  CHECK(copies == 5);
  CHECK(glued.surface.vertex_count() == strip.cut.surface->mesh.vertex_count() - copies);
  for (int v = 0; v < whole.vertex_count(); ++v) CHECK(glued.surface.positions[v] == whole.positions[v]);
  CHECK(glued.base.vertex_count() == 6);
  CHECK(glued.base.face_count() == 4);
  REQUIRE(glued.base.creases.size() == 1);
  for (int b : glued.base.creases[0]) CHECK(glued.surface.positions[glued.base.vertices[b]].x() == 1.0);
  CHECK(glued.base.creases[0][0] < glued.base.creases[0][1]);
  // The base closes up across the crease: four outer sides on each... six in all are on the boundary.
  CHECK(std::count(glued.base.twins.begin(), glued.base.twins.end(), -1) == 6);
}

TEST_CASE("hybrid leaves a flat disc alone, whatever the weights") {
  for (Weights kind : kWeights) {
    Parameterization map = exact_maps::quadrisected(shapes::sector_disc(6, 0), 3);
    const Atlas exact = atlas_of(map);
    Atlas atlas = exact;
    const LinearWeights weights(*atlas.surface, kind);
    Progress quiet;
    relax_patch_pairs(atlas, weights, 3, quiet);
    CHECK(off(atlas, exact) < 1e-12);
    CHECK(check_map(atlas.finish({})).valid());
  }
}

TEST_CASE("a single pair of patches is solved in one pass: on a lattice all places are the means of their six") {
  const Atlas exact = atlas_of(exact_maps::quadrisected(shapes::grid(1, 1), 3));
  Atlas atlas = shaken(shapes::grid(1, 1), 3, 0.15);
  CHECK(off(atlas, exact) > 1e-3);
  const LinearWeights weights(*atlas.surface, Weights::Uniform);
  Progress quiet;
  relax_patch_pairs(atlas, weights, 1, quiet);
  CHECK(off(atlas, exact) < 1e-10);
}

TEST_CASE("pass after pass the pairs come nearer to the smooth map, and none folds") {
  const Atlas exact = atlas_of(exact_maps::quadrisected(shapes::lattice_torus(3, 3), 2));
  Atlas atlas = shaken(shapes::lattice_torus(3, 3), 2, 0.15);
  const LinearWeights weights(*atlas.surface, Weights::Uniform);
  Progress quiet;
  double before = off(atlas, exact);
  for (int pass = 0; pass < 4; ++pass) {
    relax_patch_pairs(atlas, weights, 1, quiet);
    const double after = off(atlas, exact);
    CHECK(after < 0.7 * before);
    CHECK(find_folds(atlas).none());
    before = after;
  }
}

TEST_CASE("hybrid may be cancelled, and says so") {
  Atlas atlas = shaken(shapes::grid(2, 2), 1, 0.1);
  const LinearWeights weights(*atlas.surface, Weights::Uniform);
  Progress cancelled([](const std::string&, double fraction) { return fraction < 0.4; });
  CHECK(cause_of([&] { relax_patch_pairs(atlas, weights, 2, cancelled); }) == Cause::Cancelled);
}

TEST_CASE("the paper's map of a lattice torus onto a lattice base is the flat one") {
  // Each free vertex is the mean of its six neighbours, which is the linear system with uniform weights.
  const Atlas exact = atlas_of(exact_maps::quadrisected(shapes::lattice_torus(3, 3), 2));
  const Atlas start = shaken(shapes::lattice_torus(3, 3), 2, 0.15);
  ParameterizeOptions options = paper_options();
  options.weights = Weights::Uniform;
  options.relaxations = 0;
  Progress quiet;
  const SmoothedMap fixed = linear_map(start, options, quiet);
  CHECK(off(fixed.atlas, exact) < 1e-10);
  CHECK(fixed.record.flips_before_repair == 0);
  CHECK(fixed.record.held_vertices == 0);
  CHECK(fixed.record.rounds == 0);
  CHECK(fixed.record.edges_flipped == 0);
  // Corners lie where they should already: relaxing them finds no better vertex.
  options.relaxations = 2;
  const SmoothedMap relaxed = linear_map(start, options, quiet);
  CHECK(off(relaxed.atlas, exact) < 1e-9);
  CHECK(relaxed.atlas.base.vertices == exact.base.vertices);
}

TEST_CASE("a corner beside its place is relaxed back to it") {
  const Atlas exact = atlas_of(exact_maps::quadrisected(shapes::lattice_torus(3, 3), 3));
  Atlas start = exact;
  CornerDisc disc(start, 0.45, 4);
  REQUIRE(disc.collect());
  const int beside = disc.nearest_to(0.125);
  REQUIRE(disc.draw_to_center(beside));
  CornerMove move;
  move.base_vertex = 4;
  REQUIRE(make_move(disc, beside, move));
  exchange(start, move);
  REQUIRE(start.base.vertices != exact.base.vertices);
  ParameterizeOptions options = paper_options();
  options.weights = Weights::Uniform;
  Progress quiet;
  options.relaxations = 0;
  CHECK(off(linear_map(start, options, quiet).atlas, exact) > 1e-3);
  options.relaxations = 4;
  const SmoothedMap relaxed = linear_map(start, options, quiet);
  CHECK(relaxed.atlas.base.vertices == exact.base.vertices);
  CHECK(off(relaxed.atlas, exact) < 1e-9);
}

TEST_CASE("options are named and read back, and other words refused") {
  for (Method m : kMethods) CHECK(method_of(method_name(m)) == m);
  for (Objective o : kObjectives) CHECK(objective_of(objective_name(o)) == o);
  for (Weights w : kWeights) CHECK(weights_of(weights_name(w)) == w);
  for (Corners c : kCorners) CHECK(corners_of(corners_name(c)) == c);
  for (BaseEdges b : kBaseEdges) CHECK(base_edges_of(base_edges_name(b)) == b);
  for (Priority p : kPriorities) CHECK(priority_of(priority_name(p)) == p);
  CHECK(method_name(Method::MapsSmoothed) == std::string("maps-smoothed"));
  for (const char* word : {"", "Gsp", "linear ", "uniform,"}) {
    CHECK(cause_of([&] { method_of(word); }) == Cause::BadOption);
    CHECK(cause_of([&] { objective_of(word); }) == Cause::BadOption);
    CHECK(cause_of([&] { weights_of(word); }) == Cause::BadOption);
    CHECK(cause_of([&] { corners_of(word); }) == Cause::BadOption);
    CHECK(cause_of([&] { base_edges_of(word); }) == Cause::BadOption);
    CHECK(cause_of([&] { priority_of(word); }) == Cause::BadOption);
  }
  const ParameterizeOptions paper = paper_options();
  CHECK(paper.objective == Objective::Linear);
  CHECK(paper.weights == Weights::MeanValue);
  CHECK(paper.corners == Corners::Relax);
  CHECK(paper.base_edges == BaseEdges::Keep);
  CHECK(OmegaRecord{9, 1.0, 2.0, 4.0}.omega() == 7.0);
}
