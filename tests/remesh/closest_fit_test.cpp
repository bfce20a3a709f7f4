#include "remesh/closest_fit.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "remesh/remesh.h"
#include "tests/remesh/bumpy.h"
#include "tests/remesh/worst.h"
#include "tests/support/exact_maps.h"

using namespace gsp;

namespace {

/// Mean square of the distances of points to the faces of a mesh that is near them.
double mean_square(const SemiregularMesh& mesh, const std::vector<Vec3>& points) {
  const Mesh faces = mesh.mesh();
  const SubdivisionLevel level = base_level(faces.vertex_count(), faces.faces);
  double sum = 0.0;
  for (const Vec3& p : points) {
    double least = HUGE_VAL;
    for (int f = 0; f < level.face_count(); ++f) {
      if ((faces.positions[level.faces[f][0]] - p).squaredNorm() > 0.25) continue;
      LevelPlace place;
      place.face = f;
      least = std::min(least, walk_to_nearest(level, faces.positions, p, place));
    }
    sum += least;
  }
  return sum / points.size();
}

}  // namespace

// A roof over the lattice's rows, its ridge a third of the way between two of them: with a row on the ridge every face
// is in one of its planes.
TEST_CASE("vertices slide onto a crease, the freer they are the nearer", "[slow]") {
  Parameterization map = exact_maps::quadrisected(shapes::sector_disc(6, 0), 6);
  const double row = std::sqrt(0.75) / 8.0, ridge = row * 3.0 / 8.0;
  for (Vec3& p : map.surface.positions) p.z() = 1.0 - std::abs(p.y() - ridge);
  std::vector<Vec3> points;
  for (const Vec3& p : map.surface.positions)
    if (std::abs(p.x()) < 0.5 && std::abs(p.y() - ridge) < 2.0 * row) points.push_back(p);
  const auto error = [&](Positions positions) { return std::sqrt(mean_square(remeshed(map, 3, positions), points)); };
  const double sampled = error(Positions::Sampled), fitted = error(Positions::Fitted),
               closest = error(Positions::Closest);
  RemeshOptions quick{3};
  quick.most_fit_rounds = 1;
  Progress silent;
  const double one_round = std::sqrt(mean_square(remesh(map, quick, silent), points));
  CHECK(sampled > 0.01 * row);
  CHECK(one_round < sampled);
  CHECK(fitted < one_round);
  CHECK(fitted < 0.5 * sampled);
  CHECK(closest < 0.1 * sampled);
}

TEST_CASE("the fit is never farther from its samples than where it starts") {
  for (const Mesh& base : {shapes::icosahedron(), shapes::lattice_torus(4, 5), shapes::grid(2, 3)})
    for (double height : {0.01, 0.1, 0.4}) {
      const Parameterization map = bumpy(base, 3, height);
      const SemiregularMesh sampled = remeshed(map, 2, Positions::Sampled);
      const SubdivisionLevel finest = subdivision_levels(sampled.base_vertices, sampled.base_faces, 2).back();
      std::vector<Vec3> areas;
      for (const Triangle& t : finest.faces) areas.push_back(doubled_area(t, sampled.positions));
      // One sample at each corner of the faces that quadrisecting a face once more makes, and its middle.
      const SemiregularMesh finer = remeshed(map, 3, Positions::Sampled);
      const Mesh fine = finer.mesh();
      std::vector<SurfaceSample> samples;
      for (int f = 0; f < finest.face_count(); ++f) {
        const Triangle& middle = fine.faces[4 * f + 3];
        samples.push_back({fine.positions[middle[0]], 1.0 / 3.0, {f, {0.5, 0.5, 0.0}}});
        samples.push_back({fine.positions[middle[1]], 1.0 / 3.0, {f, {0.0, 0.5, 0.5}}});
        samples.push_back({fine.positions[middle[2]], 1.0 / 3.0, {f, {0.5, 0.0, 0.5}}});
      }
      const auto sum_of_squares = [&](const std::vector<Vec3>& positions) {
        double sum = 0.0;
        for (SurfaceSample sample : samples)
          sum += sample.weight * walk_to_nearest(finest, positions, sample.point, sample.place);
        return sum;
      };
      for (double stiffness : {5e-3, 5e-5}) {
        const std::vector<Vec3> moved =
            fit_closest(finest, FoldGuard(finest, areas), samples, FitEffort{stiffness}, sampled.positions);
        CHECK(sum_of_squares(moved) < sum_of_squares(sampled.positions));
        // Nothing turned that the guard sees.
        std::vector<char> held(moved.size(), 0);
        CHECK_FALSE(FoldGuard(finest, areas).hold(sampled.positions, moved, held));
        const std::vector<VertexFan> fans = vertex_fans(finest);
        for (std::size_t v = 0; v < fans.size(); ++v)
          if (fans[v].sharp_count > 0) CHECK(moved[v] == sampled.positions[v]);
      }
    }
}

TEST_CASE("samples that lie on the remesh move nothing") {
  const SemiregularMesh mesh = remeshed(bumpy(shapes::icosahedron(), 2, 0.1), 2, Positions::Sampled);
  const SubdivisionLevel finest = subdivision_levels(mesh.base_vertices, mesh.base_faces, 2).back();
  std::vector<Vec3> areas;
  std::vector<SurfaceSample> samples;
  for (int f = 0; f < finest.face_count(); ++f) {
    areas.push_back(doubled_area(finest.faces[f], mesh.positions));
    const LevelPlace place = {f, {0.5, 0.25, 0.25}};
    samples.push_back({place.at(finest, mesh.positions), 1.0, place});
  }
  CHECK(worst(fit_closest(finest, FoldGuard(finest, areas), samples, FitEffort{5e-3}, mesh.positions), mesh.positions) <
        1e-14);
}
