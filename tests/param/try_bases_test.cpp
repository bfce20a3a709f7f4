#include "param/stages/try_bases.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "mesh/shapes.h"
#include "param/energy/distortion_energy.h"
#include "param/parameterize.h"
#include "param/stages/smooth_levels.h"

using namespace gsp;

namespace {

/// Of the coarsest level, smoothed.
double energy_of(const SimplifyResult& simplified) {
  Progress progress;
  const Atlas atlas = smooth_coarsest_level(simplified, {}, progress).value().atlas;
  std::vector<int> faces(atlas.surface->mesh.faces.size()), vertices;
  std::iota(faces.begin(), faces.end(), 0);
  for (int v = 0; v < atlas.surface->mesh.vertex_count(); ++v)
    if (atlas.is_free(v)) vertices.push_back(v);
  const DistortionEnergy energy(atlas, vertices, faces, reference_shapes(atlas, faces), kMapAreaWeight);
  std::vector<double> gradient(2 * energy.variable_count());
  return energy.evaluate(energy.positions(atlas).data(), gradient.data(), 0.0);
}

std::vector<int> order_of(const SimplifyResult& simplified) {
  std::vector<int> order;
  for (int i = 0; i < simplified.removals.size(); ++i) order.push_back(simplified.removals.vertex(i));
  return order;
}

}  // namespace

TEST_CASE("of the bases tried the one of least distortion is kept, the same every time") {
  const auto surface = std::make_shared<const Surface>(shapes::torus(40, 20));
  ParameterizeOptions options;
  options.base_vertices = 20;
  Progress progress;
  const int coarsest = coarsest_level(*surface, options);
  const SimplifyResult plain = simplify(surface, options, coarsest, progress);
  const TriedBase one = best_base(surface, options, coarsest, progress);
  CHECK(order_of(one.simplified) == order_of(plain));
  double least = energy_of(plain), before = least;
  for (int number = 1; number < 4; ++number) {
    ParameterizeOptions other = options;
    other.replicate = number << 24;
    least = std::min(least, energy_of(simplify(surface, other, coarsest, progress)));
  }
  CHECK(least < before);  // else the rest would hold of the first
  options.tries = 4;
  const TriedBase best = best_base(surface, options, coarsest, progress);
  CHECK(energy_of(best.simplified) == Approx(least).epsilon(1e-12));
  CHECK(order_of(best_base(surface, options, coarsest, progress).simplified) == order_of(best.simplified));
  CHECK(order_of(simplify(surface, best.options, coarsest, progress)) == order_of(best.simplified));
}

TEST_CASE("all methods stand on the base that was kept, also one whose size the paper's stop gave") {
  const Mesh mesh = shapes::bumpy_sphere(3);
  for (int size : {16, kBaseByOmega}) {
    ParameterizeOptions options;
    options.base_vertices = size;
    Progress progress;
    const int without = parameterize(mesh, options, progress).map.base.vertex_count();
    options.tries = 5;
    options.relaxations = 0;
    options.base_edges = BaseEdges::Keep;  // so that gsp's corners stay where the simplification left them
    const auto all = parameterize_all(mesh, {Method::Gsp, Method::Maps}, options, progress);
    CHECK(all[0].map.base.vertices == all[1].map.base.vertices);
    CHECK(all[0].map.base.vertex_count() == without);
    options.method = Method::Maps;
    CHECK(parameterize(mesh, options, progress).map.base.faces == all[1].map.base.faces);
    for (int tries : {0, 65}) {
      options.tries = tries;
      CHECK_THROWS_AS(parameterize(mesh, options, progress), Error);
    }
  }
}
