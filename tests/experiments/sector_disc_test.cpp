#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "experiments/figures/sector_disc.h"

using namespace gsp;

namespace {

/// Distance from the centre of the point of the first spoke that lies at z in the chart, interpolated along the spoke.
double radius_at(const Parameterization& map, double z) {
  std::vector<std::pair<double, double>> spoke;  // chart, disc
  for (int v = 1; v < map.surface.vertex_count(); ++v) {
    const Vec3& p = map.surface.positions[v];
    // The centre is corner 0 of every chart.
    if (std::abs(std::atan2(p.y(), p.x())) < 1e-9) spoke.emplace_back(std::abs(map.position[v]), p.norm());
  }
  std::sort(spoke.begin(), spoke.end());
  const auto above = std::lower_bound(spoke.begin(), spoke.end(), std::pair(z, 0.0));
  REQUIRE(above != spoke.begin());
  REQUIRE(above != spoke.end());
  const auto below = above - 1;
  const double share = std::log(z / below->first) / std::log(above->first / below->first);
  return below->second * std::pow(above->second / below->second, share);
}

}  // namespace

TEST_CASE("around a corner of any valence the map is like z^(k/6), and like Loop subdivision") {
  // Halving the way to the corner in the chart shrinks the way on the disc by 2^(-6/k) but for modes that the rim adds.
  // Loop's own shrinkage is near it and the same only at k = 6, which is why the paper calls the two similar. Piecewise
  // linear maps approach the singularity by the power 2k/6 of the faces' size: no faster than linearly at k = 3.
  constexpr int kLevel = 6;
  for (int k = 3; k <= 12; ++k) {
    CAPTURE(k);
    const Parameterization relaxed = relaxed_sector_disc(k, kLevel), loop = loop_sector_disc(k, kLevel);
    CHECK(check_map(relaxed).valid());
    CHECK(check_map(loop).valid());
    const double ours = radius_at(relaxed, 0.3) / radius_at(relaxed, 0.6),
                 rounding = 4.0 * std::pow(2.0, -kLevel * k / 3.0);
    CHECK(ours == Approx(std::pow(2.0, -6.0 / k)).margin(0.05 + rounding));
    CHECK(ours == Approx(radius_at(loop, 0.3) / radius_at(loop, 0.6)).margin(0.08 + rounding));
  }
}
