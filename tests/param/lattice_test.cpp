#include "param/map/lattice.h"

#include <catch2/catch.hpp>

#include "mesh/random.h"
#include "param/map/base_complex.h"

using namespace gsp;

namespace {
Transition random_transition(Random& random) {
  return {static_cast<int>(random.next() % 6),
          {static_cast<int>(random.next() % 21) - 10, static_cast<int>(random.next() % 21) - 10}};
}
}  // namespace

TEST_CASE("transitions form a group that acts on the plane") {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Transition f = random_transition(random), g = random_transition(random), h = random_transition(random);
    CHECK((f * g) * h == f * (g * h));
    CHECK((f * f.inverse()).is_identity());
    CHECK((f.inverse() * f).is_identity());
    const Complex z(random.uniform(), random.uniform());
    CHECK(std::abs((f * g).apply(z) - f.apply(g.apply(z))) < 1e-12);
  }
}

TEST_CASE("crossing a base edge and coming back is the identity, and keeps the edge") {
  BaseComplex base;
  base.vertices = {0, 1, 2, 3};
  // Every relabelling of the second triangle's corners, so that each pair of edge labels occurs.
  for (int first = 0; first < 3; ++first)
    for (int second = 0; second < 3; ++second) {
      const Triangle a{0, 1, 2}, b{2, 1, 3};
      base.faces = {{a[first], a[(first + 1) % 3], a[(first + 2) % 3]},
                    {b[second], b[(second + 1) % 3], b[(second + 2) % 3]}};
      base.connect();
      for (int h = 0; h < 6; ++h) {
        if (base.twins[h] < 0) continue;
        const Transition t = base.across(h);
        CHECK((base.across(base.twins[h]) * t).is_identity());
        for (int end = 0; end < 2; ++end) {
          const int vertex = base.faces[h / 3][(h % 3 + end) % 3];
          const Triangle& there = base.faces[base.twins[h] / 3];
          for (int k = 0; k < 3; ++k)
            if (there[k] == vertex) CHECK(t.apply(kChartCorners[(h % 3 + end) % 3]) == kChartCorners[k]);
        }
      }
    }
}

TEST_CASE("going round a corner of valence k turns by k·60 degrees about it") {
  for (int valence = 3; valence <= 12; ++valence) {
    BaseComplex base;
    for (int v = 0; v <= valence; ++v) base.vertices.push_back(v);
    for (int s = 0; s < valence; ++s) base.faces.push_back({0, 1 + s, 1 + (s + 1) % valence});
    base.connect();
    Transition round;
    int face = 0;
    for (int s = 0; s < valence; ++s) {
      const int h = 3 * face + 2;  // from the rim back to the corner: the counter-clockwise side
      round = base.across(h) * round;
      face = base.twins[h] / 3;
    }
    CHECK(face == 0);
    CHECK(round.apply(Eisenstein{0, 0}) == Eisenstein{0, 0});
    CHECK((round.rotation + valence) % 6 == 0);
  }
}
