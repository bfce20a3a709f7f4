#include "coder/quantizer.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gsp {

namespace {

/// Steps are that much finer than the precision asked for, so that urgent nodes can end finer than the others.
constexpr int kSpareBits = kMaxUrgency / kPassesPerPlane;

/// Normal details of level l insert vertices of spacing 2^-(l+1).
double detail_step(const StreamHeader& header, int level) {
  return std::ldexp(1.0, header.step_exponent - (header.level - 1 - level));
}

double base_step(const StreamHeader& header) {
  return std::ldexp(1.0, header.step_exponent - header.level) * wavelet_norm(header.wavelet);
}

double origin_unit(const StreamHeader& header) { return std::ldexp(base_step(header), header.base_planes - 3); }

/// The length that precision is relative to: the diagonal where there is one, else something that resolves the place.
double extent(const std::vector<Vec3>& base, double diagonal) {
  double farthest = 0.0;
  for (const Vec3& p : base) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  constexpr double kSmallest = 1e-100;
  return std::max({diagonal, std::ldexp(farthest, -30), kSmallest});
}

/// Chooses planes and origin so that every base position lies inside, and returns the integers.
std::vector<std::array<std::uint32_t, 3>> quantize_base(const std::vector<Vec3>& base, StreamHeader& header) {
  Vec3 low = base[0], high = base[0];
  for (const Vec3& p : base) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double step = base_step(header);
  // Even a point far from the coordinates' origin has so many planes that its own origin is a number headers can hold.
  constexpr int kLeastPlanes = 6;
  for (header.base_planes = kLeastPlanes; header.base_planes < 31; ++header.base_planes) {
    const double unit = origin_unit(header);
    bool fits = true;
    for (int k = 0; k < 3; ++k) {
      header.origin[k] = static_cast<std::int64_t>(std::floor(low[k] / unit));
      fits = fits && (high[k] - header.origin[k] * unit) / step < std::ldexp(1.0, header.base_planes) - 1.0;
    }
    if (fits) break;
  }
  std::vector<std::array<std::uint32_t, 3>> integers(base.size());
  const double limit = std::ldexp(1.0, header.base_planes) - 1.0;
  for (std::size_t v = 0; v < base.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      const double offset = (base[v][k] - header.origin[k] * origin_unit(header)) / step;
      integers[v][k] = static_cast<std::uint32_t>(std::clamp(std::floor(offset), 0.0, limit));
    }
  return integers;
}

}  // namespace

double wavelet_norm(Wavelet wavelet) {
  switch (wavelet) {
    case Wavelet::Loop:
      return 0.374 / 0.5125;
    case Wavelet::Loop11:
      return 0.275 / 0.5125;
    case Wavelet::Butterfly:
      return 1.0;
    case Wavelet::ButterflyLifted:
      return 0.685 / 0.792;
  }
  return 1.0;
}

BitplaneCoefficients quantize(const std::vector<Vec3>& base, const std::vector<std::vector<Vec3>>& details,
                              double diagonal, int precision_bits, StreamHeader& header) {
  header.step_exponent = std::ilogb(extent(base, diagonal)) - precision_bits - kSpareBits;
  BitplaneCoefficients integers;
  integers.base = quantize_base(base, header);
  std::uint32_t largest = 0;
  for (int c = 0; c < 3; ++c) {
    BitplaneCoefficients::Component& component = integers.details[c];
    for (std::size_t l = 0; l < details.size(); ++l) {
      const double step = detail_step(header, static_cast<int>(l));
      for (const Vec3& d : details[l]) {
        const double steps = std::min(std::floor(std::abs(d[c]) / step), 0x1p31 - 1.0);
        component.magnitude.push_back(static_cast<std::uint32_t>(steps));
        component.negative.push_back(d[c] < 0.0);
        largest = std::max(largest, component.magnitude.back());
      }
    }
  }
  header.detail_planes = std::bit_width(largest);
  return integers;
}

std::vector<Vec3> dequantize_base(const BitplaneCoefficients& integers, const StreamHeader& header) {
  std::vector<Vec3> base(integers.base.size());
  for (std::size_t v = 0; v < base.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      const double centre = integers.base[v][k] + std::ldexp(0.5, integers.base_low_plane[v][k]);
      base[v][k] = header.origin[k] * origin_unit(header) + centre * base_step(header);
    }
  return base;
}

std::vector<Vec3> dequantize_details(const BitplaneCoefficients& integers, const EdgeForest& forest, int level,
                                     const StreamHeader& header) {
  const double step = detail_step(header, level);
  const int begin = forest.level_begin[level];
  std::vector<Vec3> details(forest.level_begin[level + 1] - begin, Vec3::Zero());
  for (int c = 0; c < 3; ++c) {
    const BitplaneCoefficients::Component& component = integers.details[c];
    for (std::size_t e = 0; e < details.size(); ++e) {
      const std::uint32_t magnitude = component.magnitude[begin + e];
      if (magnitude == 0) continue;
      const double centre = centroid(magnitude, component.low_plane[begin + e]);
      details[e][c] = centre * (component.negative[begin + e] ? -step : step);
    }
  }
  return details;
}

}  // namespace gsp
