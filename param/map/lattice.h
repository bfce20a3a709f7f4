#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

using Complex = std::complex<double>;

/// Real and imaginary part of ω = exp(iπ/3), the unit of rotation between charts.
inline constexpr double kOmegaRe = 0.5;
inline constexpr double kOmegaIm = 0.86602540378443864676;
/// Area of a base triangle in its chart, √3/4.
inline constexpr double kChartArea = 0.43301270189221932338;

/// Eisenstein integer a + bω.
struct Eisenstein {
  std::int32_t a = 0;
  std::int32_t b = 0;

  friend Eisenstein operator+(Eisenstein x, Eisenstein y) { return {x.a + y.a, x.b + y.b}; }
  friend Eisenstein operator-(Eisenstein x, Eisenstein y) { return {x.a - y.a, x.b - y.b}; }
  friend bool operator==(Eisenstein x, Eisenstein y) { return x.a == y.a && x.b == y.b; }
  Complex value() const { return {a + kOmegaRe * b, kOmegaIm * b}; }
};

/// ω·x, since ω² = ω - 1.
inline Eisenstein times_omega(Eisenstein x) { return {-x.b, x.a + x.b}; }

inline Eisenstein rotate(Eisenstein x, int sixths) {
  for (int k = ((sixths % 6) + 6) % 6; k > 0; --k) x = times_omega(x);
  return x;
}

/// ω^k with the exact values of cosine and sine.
inline Complex omega_power(int sixths) {
  static constexpr double re[6] = {1.0, kOmegaRe, -kOmegaRe, -1.0, -kOmegaRe, kOmegaRe};
  static constexpr double im[6] = {0.0, kOmegaIm, kOmegaIm, 0.0, -kOmegaIm, -kOmegaIm};
  const int k = ((sixths % 6) + 6) % 6;
  return {re[k], im[k]};
}

/// Change of chart z -> ω^k z + t in exact integers, so that "two routes agree" is an equality
/// (algorithms.md §1; the paper's τ(u,v) = (-u, 1-v) is one of these with aligned corner labels).
struct Transition {
  std::int32_t rotation = 0;  ///< k in 0..5
  Eisenstein translation;     ///< t

  Complex apply(Complex z) const { return omega_power(rotation) * z + translation.value(); }
  Eisenstein apply(Eisenstein x) const { return rotate(x, rotation) + translation; }

  Transition inverse() const {
    const int k = (6 - rotation) % 6;
    return {k, Eisenstein{} - rotate(translation, k)};
  }
  bool is_identity() const { return rotation == 0 && translation == Eisenstein{}; }

  /// (f * g)(z) = f(g(z)).
  friend Transition operator*(const Transition& f, const Transition& g) {
    return {(f.rotation + g.rotation) % 6, f.apply(g.translation)};
  }
  friend bool operator==(const Transition& f, const Transition& g) {
    return f.rotation == g.rotation && f.translation == g.translation;
  }
};

inline Eisenstein nearest_lattice_point(Complex z) {
  const double b = z.imag() / kOmegaIm;
  return {static_cast<std::int32_t>(std::lround(z.real() - kOmegaRe * b)), static_cast<std::int32_t>(std::lround(b))};
}

/// The corners of a chart: 0, 1 and ω.
inline constexpr std::array<Eisenstein, 3> kChartCorners = {Eisenstein{0, 0}, Eisenstein{1, 0}, Eisenstein{0, 1}};

/// Barycentric coordinates of z with respect to the chart's corners 0, 1, 2.
inline std::array<double, 3> chart_barycentric(Complex z) {
  const double w2 = z.imag() / kOmegaIm;
  const double w1 = z.real() - kOmegaRe * w2;
  return {1.0 - w1 - w2, w1, w2};
}

/// The chart position with weights u, v for corners 0 and 1 (corner 2 has 1-u-v).
inline Complex chart_position(double u, double v) {
  const double w2 = 1.0 - u - v;
  return {v + kOmegaRe * w2, kOmegaIm * w2};
}

/// Twice the signed area of a chart triangle.
inline double cross(Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); }
inline double chart_area(Complex a, Complex b, Complex c) { return 0.5 * cross(b - a, c - a); }

}  // namespace gsp
