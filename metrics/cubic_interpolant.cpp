#include "metrics/cubic_interpolant.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace gsp {

namespace {

std::vector<double> secants(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> m;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) m.push_back((y[i + 1] - y[i]) / (x[i + 1] - x[i]));
  return m;
}

/// Slope at the end of the first of two intervals, kept from overshooting (Fritsch and Butland as in common practice).
double end_slope(double h0, double h1, double m0, double m1) {
  const double slope = ((2.0 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
  if (slope * m0 <= 0.0) return 0.0;
  if (m0 * m1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(m0)) return 3.0 * m0;
  return slope;
}

}  // namespace

CubicInterpolant CubicInterpolant::akima(std::vector<double> x, std::vector<double> y) {
  const std::vector<double> inner = secants(x, y);
  const std::size_t n = x.size();
  if (n == 2) return {std::move(x), std::move(y), {inner[0], inner[0]}};
  // Two secants beyond each end, so that m[i + 2] is the one right of knot i.
  std::vector<double> m = {3.0 * inner[0] - 2.0 * inner[1], 2.0 * inner[0] - inner[1]};
  m.insert(m.end(), inner.begin(), inner.end());
  m.push_back(2.0 * inner[n - 2] - inner[n - 3]);
  m.push_back(3.0 * inner[n - 2] - 2.0 * inner[n - 3]);
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < m.size(); ++i) largest = std::max(largest, std::abs(m[i + 1] - m[i]));
  std::vector<double> slopes;
  for (std::size_t i = 0; i < n; ++i) {
    const double right = std::abs(m[i + 3] - m[i + 2]), left = std::abs(m[i + 1] - m[i]);
    // Where both sides are straight the formula is 0/0.
    slopes.push_back(right + left > 1e-9 * largest ? (right * m[i + 1] + left * m[i + 2]) / (right + left)
                                                   : 0.5 * (m[i + 1] + m[i + 2]));
  }
  return {std::move(x), std::move(y), std::move(slopes)};
}

CubicInterpolant CubicInterpolant::pchip(std::vector<double> x, std::vector<double> y) {
  const std::vector<double> m = secants(x, y);
  const std::size_t n = x.size();
  if (n == 2) return {std::move(x), std::move(y), {m[0], m[0]}};
  const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
  std::vector<double> slopes(n, 0.0);
  slopes.front() = end_slope(h(0), h(1), m[0], m[1]);
  slopes.back() = end_slope(h(n - 2), h(n - 3), m[n - 2], m[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (m[i - 1] * m[i] <= 0.0) continue;
    const double before = 2.0 * h(i) + h(i - 1), after = h(i) + 2.0 * h(i - 1);
    slopes[i] = (before + after) / (before / m[i - 1] + after / m[i]);
  }
  return {std::move(x), std::move(y), std::move(slopes)};
}

CubicInterpolant CubicInterpolant::least_squares(const std::vector<double>& x, const std::vector<double>& y) {
  const double centre = 0.5 * (x.front() + x.back()), half = 0.5 * (x.back() - x.front());
  const auto rows = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd powers(rows, 4);
  Eigen::VectorXd values(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double t = (x[i] - centre) / half;
    powers.row(i) << 1.0, t, t * t, t * t * t;
    values[i] = y[i];
  }
  const Eigen::Vector4d c = powers.colPivHouseholderQr().solve(values);
  const auto value = [&](double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); };
  const auto slope = [&](double t) { return (c[1] + t * (2.0 * c[2] + 3.0 * t * c[3])) / half; };
  return {{x.front(), x.back()}, {value(-1.0), value(1.0)}, {slope(-1.0), slope(1.0)}};
}

std::size_t CubicInterpolant::interval(double x) const {
  const auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  return static_cast<std::size_t>(after - x_.begin()) - 1;
}

double CubicInterpolant::value(double x) const {
  const std::size_t i = interval(x);
  const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * y_[i] + t * t * (3.0 - 2.0 * t) * y_[i + 1] +
         h * t * s * (s * slopes_[i] - t * slopes_[i + 1]);
}

double CubicInterpolant::integral_within(std::size_t i, double offset) const {
  const double h = x_[i + 1] - x_[i], t = offset / h, t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
  return h * ((t - t3 + 0.5 * t4) * y_[i] + (t3 - 0.5 * t4) * y_[i + 1] +
              h * ((0.5 * t2 - 2.0 / 3.0 * t3 + 0.25 * t4) * slopes_[i] + (0.25 * t4 - t3 / 3.0) * slopes_[i + 1]));
}

double CubicInterpolant::integral(double from, double to) const {
  const std::size_t first = interval(from), last = interval(to);
  double sum = integral_within(last, to - x_[last]) - integral_within(first, from - x_[first]);
  for (std::size_t i = first; i < last; ++i) sum += integral_within(i, x_[i + 1] - x_[i]);
  return sum;
}

}  // namespace gsp
