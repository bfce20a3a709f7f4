#include "remesh/filters/cosine.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gsp;

TEST_CASE("cosines of fractions of a turn are exact where they are simple and right to the last bit or two elsewhere") {
  CHECK(cosine_of_turn(0, 7) == 1.0);
  CHECK(cosine_of_turn(1, 4) == 0.0);
  CHECK(cosine_of_turn(1, 2) == -1.0);
  CHECK(cosine_of_turn(3, 4) == 0.0);
  CHECK(cosine_of_turn(7, 7) == 1.0);
  CHECK(cosine_of_turn(1, 6) == Approx(0.5).margin(2e-16));
  CHECK(cosine_of_turn(1, 3) == Approx(-0.5).margin(2e-16));
  CHECK(cosine_of_turn(1, 5) == Approx((std::sqrt(5.0) - 1.0) / 4.0).margin(2e-16));
  for (int k = 1; k <= 400; ++k)
    for (int j = 0; j <= k; ++j) {
      // In long double, since the angle's own rounding is larger than what is tested.
      const long double expected = std::cos(2.0L * 3.14159265358979323846264338327950288L * j / k);
      REQUIRE(std::abs(static_cast<double>(cosine_of_turn(j, k) - expected)) <= 0x1p-52);
      REQUIRE(cosine_of_turn(j, k) == cosine_of_turn(k - j, k));
    }
}
