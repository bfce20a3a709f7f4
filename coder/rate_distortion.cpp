#include "coder/rate_distortion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "coder/quantizer.h"

namespace gsp {

BitplaneCoefficients rate_distortion_choice(const BitplaneCoefficients& integers, const BitplaneState& state,
                                            double bit_worth) {
  BitplaneCoefficients chosen = integers;
  constexpr double kSignificant = 1.0 + kFirstCentroid;
  for (int c = 0; c < 3; ++c)
    for (std::size_t n = 0; n < chosen.details[c].magnitude.size(); ++n) {
      const float price = state.news_price[c][n];
      const int plane = state.known.details[c].low_plane[n];
      std::uint32_t& magnitude = chosen.details[c].magnitude[n];
      if (price == BitplaneState::kNoPrice || magnitude >> plane > 1) continue;
      const std::uint32_t threshold = 1u << plane;
      const double x = (magnitude + 0.5) / threshold;
      const double saved = x * x - (x - kSignificant) * (x - kSignificant);
      if (saved > bit_worth * price)
        magnitude = std::max(magnitude, threshold);
      else
        magnitude = std::min(magnitude, threshold - 1);
    }
  return chosen;
}

SurfaceError::SurfaceError(Mesh mesh)
    : positions_(std::move(mesh.positions)), normals_(positions_.size(), Vec3::Zero()) {
  for (const Triangle& t : mesh.faces) {
    const Vec3 area = (positions_[t[1]] - positions_[t[0]]).cross(positions_[t[2]] - positions_[t[0]]);
    for (int v : t) normals_[v] += area;
  }
  for (Vec3& normal : normals_)
    if (const double size = normal.norm(); size > 0.0) normal /= std::sqrt(size);
}

double SurfaceError::of(const std::vector<Vec3>& moved) const {
  double sum = 0.0;
  for (std::size_t v = 0; v < moved.size(); ++v) {
    const double along = normals_[v].dot(moved[v] - positions_[v]);
    sum += along * along;
  }
  return sum;
}

}  // namespace gsp
