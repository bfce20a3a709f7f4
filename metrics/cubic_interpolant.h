#pragma once

#include <vector>

namespace gsp {

/// A cubic polynomial on each interval between knots, given by values and slopes at the knots (Hermite form).
class CubicInterpolant {
 public:
  /// x: #K >= 2, strictly increasing; y: #K. Slopes by Akima 1970, ends extrapolated as there.
  static CubicInterpolant akima(std::vector<double> x, std::vector<double> y);
  /// Slopes by Fritsch and Butland 1984, ends by the three-point formula, kept monotone.
  static CubicInterpolant pchip(std::vector<double> x, std::vector<double> y);
  /// One cubic over the whole range by least squares; exact for #K = 4, the least it takes.
  static CubicInterpolant least_squares(const std::vector<double>& x, const std::vector<double>& y);

  double front() const { return x_.front(); }
  double back() const { return x_.back(); }
  /// At x in [front, back].
  double value(double x) const;
  /// Over [from, to] within [front, back], exact up to rounding.
  double integral(double from, double to) const;

 private:
  CubicInterpolant(std::vector<double> x, std::vector<double> y, std::vector<double> slopes)
      : x_(std::move(x)), y_(std::move(y)), slopes_(std::move(slopes)) {}
  /// From knot i to x_[i] + offset.
  double integral_within(std::size_t i, double offset) const;
  std::size_t interval(double x) const;

  std::vector<double> x_, y_, slopes_;
};

}  // namespace gsp
