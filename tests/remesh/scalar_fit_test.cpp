#include "remesh/scalar/scalar_fit.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/scalar/scalar_synthesis.h"
#include "tests/by_threads.h"

using namespace gsp;

namespace {

Vec3 any_vector(Random& random) { return {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5}; }

/// Levels of a base, which of its vertices have three numbers, and a form with details of every kind.
struct Scalars {
  std::vector<SubdivisionLevel> levels;
  std::vector<char> exceptional;
  ScalarForm form;

  Scalars(const Mesh& base, int level, double size, int every_exception) {
    levels = subdivision_levels(base.vertex_count(), base.faces, level);
    form.base = base.positions;
    Random random(5);
    for (int l = 0; l < level; ++l)
      for (int e = 0; e < levels[l].edge_count(); ++e) {
        const bool three = levels[l].edge_faces[e][1] < 0 || (every_exception > 0 && e % every_exception == 0);
        exceptional.push_back(three);
        Vec3 detail = std::ldexp(size, -2 * l) * any_vector(random);
        if (!three) detail.tail<2>().setZero();
        form.details.push_back(detail);
      }
  }
};

/// Points of a level's faces, where they are.
std::vector<SurfaceSample> samples_of(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < level.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      SurfaceSample sample;
      sample.weight = 1.0 / 3.0;
      sample.place.face = f;
      sample.place.weights = {1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0};
      sample.place.weights[k] = 2.0 / 3.0;
      sample.point = sample.place.at(level, positions);
      samples.push_back(sample);
    }
  return samples;
}

}  // namespace

TEST_CASE("a mesh made of a scalar form has that form") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(3, 4)})
    for (bool lifted : {false, true}) {
      const Scalars scalars(base, 4, 0.2, 7);
      ScalarSynthesis synthesis(scalars.levels, scalars.exceptional, lifted);
      const ScalarForm again = synthesis.of(synthesis.positions(scalars.form));
      CHECK(std::sqrt(again.plus(scalars.form, -1.0).dot(again.plus(scalars.form, -1.0))) < 1e-12);
    }
}

TEST_CASE("what forces do to a form is the transpose of what the form does to positions") {
  for (bool lifted : {false, true}) {
    const Scalars scalars(shapes::grid(3, 4), 3, 0.2, 5);
    ScalarSynthesis synthesis(scalars.levels, scalars.exceptional, lifted);
    const std::vector<Vec3> positions = synthesis.positions(scalars.form);
    Random random(8);
    std::vector<Vec3> forces;
    for (std::size_t v = 0; v < positions.size(); ++v) forces.push_back(any_vector(random));
    const std::vector<Vec3> moves = synthesis.moves(scalars.form);
    double work = 0.0;
    for (std::size_t v = 0; v < moves.size(); ++v) work += moves[v].dot(forces[v]);
    CHECK(synthesis.pulled(forces).dot(scalars.form) == Approx(work).epsilon(1e-12));
  }
}

TEST_CASE("on the finest level moves are the derivative of positions") {
  const Scalars scalars(shapes::icosahedron(), 3, 0.2, 0);
  ScalarSynthesis synthesis(scalars.levels, scalars.exceptional, true);
  const std::vector<Vec3> before = synthesis.positions(scalars.form);
  ScalarForm change = scalars.form.plus(scalars.form, -1.0);
  const std::size_t finest = scalars.levels[2].vertex_count - scalars.levels[0].vertex_count;
  for (std::size_t n = finest; n < change.details.size(); ++n) change.details[n].x() = 1e-3 * std::cos(n);
  const std::vector<Vec3> moves = synthesis.moves(change), after = synthesis.positions(scalars.form.plus(change, 1.0));
  double farthest = 0.0;
  for (std::size_t v = 0; v < moves.size(); ++v)
    farthest = std::max(farthest, (after[v] - before[v] - moves[v]).norm());
  CHECK(farthest < 1e-14);
}

TEST_CASE("a scalar form is found again from the surface that it makes") {
  for (bool lifted : {false, true}) {
    const Scalars scalars(shapes::icosahedron(), 3, 0.1, 0);
    ScalarSynthesis synthesis(scalars.levels, scalars.exceptional, lifted);
    const std::vector<Vec3> wanted = synthesis.positions(scalars.form);
    // Start beside it: every number off by about a tenth of its level's size.
    Random random(2);
    ScalarForm start = scalars.form;
    std::size_t n = 0;
    for (int l = 0; l < 3; ++l)
      for (int e = 0; e < scalars.levels[l].edge_count(); ++e)
        start.details[n++].x() += std::ldexp(0.01, -2 * l) * (random.uniform() - 0.5);
    const std::vector<Vec3> beside = synthesis.positions(start);
    const std::vector<SurfaceSample> samples = samples_of(scalars.levels.back(), wanted);
    const FitEffort none{1e-6, 0.03, 0}, full{1e-6, 0.0, 20};
    const double before = fit_scalars(scalars.levels, scalars.exceptional, lifted, samples, none, beside).rms;
    const ScalarFit found = fit_scalars(scalars.levels, scalars.exceptional, lifted, samples, full, beside);
    CHECK(before > 1e-3);
    CHECK(found.rms < 0.02 * before);
    // Every detail is still normal.
    const ScalarForm form = synthesis.of(found.positions);
    const std::vector<Vec3> again = synthesis.positions(form);
    double farthest = 0.0;
    for (std::size_t v = 0; v < again.size(); ++v)
      farthest = std::max(farthest, (again[v] - found.positions[v]).norm());
    CHECK(farthest < 1e-12);
  }
}

TEST_CASE("a scalar fit holds boundaries and is the same bits on one thread and on two") {
  const Scalars scalars(shapes::grid(3, 4), 3, 0.3, 9);
  ScalarSynthesis synthesis(scalars.levels, scalars.exceptional, true);
  const std::vector<Vec3> start = synthesis.positions(scalars.form);
  std::vector<SurfaceSample> samples = samples_of(scalars.levels.back(), start);
  for (SurfaceSample& sample : samples) sample.point.z() += 0.02 * std::cos(sample.point.x());
  const auto [one, two] = by_one_and_two_threads(
      [&] { return fit_scalars(scalars.levels, scalars.exceptional, true, samples, {5e-3}, start); });
  CHECK(one.positions == two.positions);
  CHECK(one.rms < 0.01);
}
