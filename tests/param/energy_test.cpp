#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "mesh/random.h"
#include "mesh/shapes.h"
#include "param/atlas/folds.h"
#include "param/energy/lower_peaks.h"
#include "param/energy/newton_descent.h"
#include "param/energy/untangle.h"
#include "small_maps.h"

using namespace gsp;

namespace {

std::vector<int> all_of(int count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> free_vertices(const Atlas& atlas) {
  std::vector<int> free;
  for (int v = 0; v < static_cast<int>(atlas.patch.size()); ++v)
    if (atlas.is_free(v)) free.push_back(v);
  return free;
}

/// A torus cut from the hexagonal lattice on the same torus as its base, each face in four or more: flat, and an
/// isometry up to one scale. The surface itself is the flat one, so that shapes are those of the charts.
struct FlatTorus {
  Atlas atlas = own();
  std::vector<int> free = free_vertices(atlas), faces = all_of(atlas.surface->mesh.face_count());
  std::vector<ReferenceShape> shapes = equilateral();

  static Atlas own() { return atlas_of(exact_maps::quadrisected(shapes::lattice_torus(3, 3), 2)); }
  /// The shape that every face has in its chart: side 1/4.
  std::vector<ReferenceShape> equilateral() const {
    const double side = 0.25, height = side * kOmegaIm;
    return std::vector<ReferenceShape>(faces.size(),
                                       {{1.0 / side, -0.5 * side / (side * height), 1.0 / height}, 1.0 / faces.size()});
  }
  DistortionEnergy energy() const { return {atlas, free, faces, shapes, kMapAreaWeight}; }
};

/// The six faces around one free vertex of the torus; all else is held.
struct OneVertex {
  FlatTorus torus;
  std::vector<int> vertex = {torus.free[7]}, faces = faces_around(*torus.atlas.surface, vertex);
  std::vector<ReferenceShape> shapes = std::vector<ReferenceShape>(faces.size(), torus.shapes[0]);
  Complex middle = torus.atlas.position[vertex[0]];

  DistortionEnergy energy() const { return {torus.atlas, vertex, faces, shapes, kMapAreaWeight}; }
};

}  // namespace

TEST_CASE("an isometry is the least energy: Newton's method finds nothing to gain there") {
  const FlatTorus torus;
  const DistortionEnergy energy = torus.energy();
  std::vector<double> x = energy.positions(torus.atlas);
  NewtonDescent descent(energy, x);
  CHECK(descent.value() == Approx(1.0 + kMapAreaWeight).epsilon(1e-12));
  CHECK(descent.step() < 1e-12);
}

TEST_CASE("near its minimum the energy is quadratic: a Newton step squares what is left") {
  OneVertex one;
  const DistortionEnergy energy = one.energy();
  const double least = energy.density(0, energy.positions(one.torus.atlas).data());
  CHECK(least == Approx(2.0));
  std::vector<double> x = {one.middle.real() + 0.01, one.middle.imag() - 0.006};
  NewtonDescent descent(energy, x);
  double off = std::hypot(x[0] - one.middle.real(), x[1] - one.middle.imag());
  for (int step = 0; step < 3; ++step) {
    const double before = off, value = descent.value();
    const double gained = descent.step();
    CHECK(gained == Approx((value - descent.value()) / value).margin(1e-14));
    off = std::hypot(x[0] - one.middle.real(), x[1] - one.middle.imag());
    CHECK(off < std::max(before * before / 0.01, 1e-10));
  }
  CHECK(off < 1e-9);
}

TEST_CASE("Newton's method brings a map that was shaken back to the isometry") {
  Parameterization shaken = exact_maps::quadrisected(shapes::lattice_torus(3, 3), 2);
  exact_maps::jitter(shaken, 0.15, 2, 77);
  const Atlas start = atlas_of(shaken);
  FlatTorus torus;
  torus.atlas = start;
  const DistortionEnergy energy = torus.energy();
  std::vector<double> x = energy.positions(start);
  NewtonDescent descent(energy, x);
  const double before = descent.value();
  CHECK(before > 2.02);
  for (int step = 0; step < 12 && descent.step() > 1e-13; ++step) CHECK(energy.upright(x));
  CHECK(descent.value() == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("a vertex pressed against a side is lowered from its peak, others stay where they are") {
  OneVertex one;
  const DistortionEnergy energy = one.energy();
  // All but on the line between two neighbours, at 0.97 of the way.
  const Complex toward = one.middle + 0.97 * 0.25 * kOmegaIm * std::polar(1.0, std::acos(-1.0) / 6);
  std::vector<double> x = {toward.real(), toward.imag()};
  REQUIRE(energy.upright(x));
  double peak = 0.0;
  for (int f = 0; f < energy.face_count(); ++f) peak = std::max(peak, energy.density(f, x.data()));
  REQUIRE(peak > 10.0);
  lower_peaks(energy, x);
  double after = 0.0;
  for (int f = 0; f < energy.face_count(); ++f) after = std::max(after, energy.density(f, x.data()));
  CHECK(after <= 10.0);
  CHECK(energy.upright(x));
  // Where nothing is a peak nothing moves.
  std::vector<double> calm = {one.middle.real() + 0.02, one.middle.imag()};
  const std::vector<double> same = calm;
  lower_peaks(energy, calm);
  CHECK(calm == same);
}

TEST_CASE("a vertex pushed through the opposite side comes free, and the rest stays bit for bit") {
  const FlatTorus torus;
  Atlas atlas = torus.atlas;
  const int v = torus.free[11];
  atlas.position[v] += Complex(0.35, 0.2);  // edges are 1/4 long
  const Folds folds = find_folds(atlas);
  REQUIRE(!folds.faces.empty());
  const Atlas folded = atlas;
  Progress quiet;
  CHECK(repair_folds(atlas, 8, quiet).none());
  CHECK(find_folds(atlas).none());
  CHECK(atlas.transition == folded.transition);
  CHECK(atlas.patch == folded.patch);
  const FoldRings near = rings_around(*atlas.surface, folds, 8);
  int moved = 0;
  for (int w = 0; w < static_cast<int>(atlas.patch.size()); ++w) {
    if (atlas.position[w] == folded.position[w]) continue;
    ++moved;
    CHECK(near.distance[w] >= 0);
  }
  CHECK(moved > 0);
  CHECK(moved < static_cast<int>(atlas.patch.size()) / 2);
  CHECK(check_map([&] {
          atlas.reassign_all();
          return atlas.finish({});
        }())
            .valid());
}

TEST_CASE("two folds far apart are taken apart on their own") {
  FlatTorus torus;
  Atlas& atlas = torus.atlas;
  const int first = torus.free.front();
  int second = -1;
  const FoldRings around = rings_around(*atlas.surface, Folds{{}, {first}}, 100);
  for (int v : around.vertices)
    if (atlas.is_free(v)) second = v;  // the farthest
  for (int v : {first, second}) atlas.position[v] += Complex(-0.3, 0.1);
  for (int v : {first, second}) REQUIRE(local_map(atlas, v) == LocalMap::Folded);
  Progress quiet;
  CHECK(repair_folds(atlas, 8, quiet).none());
}

TEST_CASE("where nothing is free to move nothing moves") {
  // Every vertex of the base's own faces is a patch corner.
  Atlas atlas = own_base(shapes::icosahedron());
  const std::vector<Complex> before = atlas.position;
  Progress quiet;
  CHECK(repair_folds(atlas, 4, quiet).none());
  CHECK(atlas.position == before);
}

TEST_CASE("what comes free is never wound wrongly about a corner of many patches") {
  // Around a corner of ten patches, 600 degrees, a vertex can end up with a turn that is the corner's.
  const Atlas exact = atlas_of(exact_maps::quadrisected(shapes::sector_disc(10, 1), 1));
  Random random(9);
  Progress quiet;
  int freed = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Atlas atlas = exact;
    for (int v : free_vertices(exact))
      if (random.uniform() < 0.3) atlas.position[v] += Complex(random.uniform() - 0.5, random.uniform() - 0.5);
    if (find_folds(atlas).faces.empty()) continue;
    const Folds left = repair_folds(atlas, 4, quiet);
    freed += left.none();
    CHECK((left.vertices.empty() || !left.faces.empty()));
  }
  CHECK(freed > 0);
}

TEST_CASE("with more of ε the energy is finite over folds, and drives them apart") {
  OneVertex one;
  const DistortionEnergy energy = one.energy();
  std::vector<double> x = {one.middle.real() + 0.4, one.middle.imag() + 0.05};
  CHECK_FALSE(energy.upright(x));
  CHECK(energy.least_determinant(x) < 0.0);
  CHECK(drive_apart(energy, x, 50));
  CHECK(energy.upright(x));
  CHECK(energy.least_determinant(x) > 0.0);
  // Where the rim is folded itself there is no place for the vertex.
  OneVertex crossed;
  const int w =
      crossed.torus.atlas.surface->halfedges.to(crossed.torus.atlas.surface->halfedges.outgoing[crossed.vertex[0]]);
  crossed.torus.atlas.position[w] += 1.5 * std::polar(1.0, 0.3);
  const DistortionEnergy hopeless = crossed.energy();
  std::vector<double> y = hopeless.positions(crossed.torus.atlas);
  CHECK(drive_apart(hopeless, y, 50) == hopeless.upright(y));
}

TEST_CASE("equilateral shapes are as large as the images: on the lattice the shape of every face") {
  const FlatTorus torus;
  const std::vector<ReferenceShape> shapes = equilateral_shapes(torus.atlas, torus.faces);
  REQUIRE(shapes.size() == torus.shapes.size());
  for (std::size_t f = 0; f < shapes.size(); ++f) {
    for (int k = 0; k < 3; ++k) CHECK(shapes[f].inverse[k] == Approx(torus.shapes[f].inverse[k]));
    CHECK(shapes[f].weight == Approx(torus.shapes[f].weight));
  }
}
