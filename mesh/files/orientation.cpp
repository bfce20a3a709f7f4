#include "mesh/files/orientation.h"

#include <array>
#include <cmath>
#include <limits>

namespace gsp {

namespace {

int sign(double x) { return (x > 0.0) - (x < 0.0); }

/// An exact sum of doubles, as parts that do not overlap, the smallest first (Shewchuk's grow-expansion).
class ExactSum {
 public:
  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  int sign_of_sum() const {
    for (std::size_t i = count_; i > 0; --i)
      if (parts_[i - 1] != 0.0) return sign(parts_[i - 1]);
    return 0;
  }

 private:
  void add(double term) {
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = term + parts_[i], virtual_part = sum - term;
      parts_[i] = (term - (sum - virtual_part)) + (parts_[i] - virtual_part);
      term = sum;
    }
    parts_[count_++] = term;
  }

  std::array<double, 12> parts_;
  std::size_t count_ = 0;
};

}  // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y()), right = (a.y() - c.y()) * (b.x() - c.x());
  constexpr double unit = 0.5 * std::numeric_limits<double>::epsilon();
  const double area = left - right;
  // Shewchuk's bound A of orient2d: beyond it the rounded sign is right.
  if (std::abs(area) > (3.0 + 16.0 * unit) * unit * (std::abs(left) + std::abs(right))) return sign(area);
  ExactSum sum;
  sum.add_product(a.x(), b.y());
  sum.add_product(-a.x(), c.y());
  sum.add_product(-c.x(), b.y());
  sum.add_product(-a.y(), b.x());
  sum.add_product(a.y(), c.x());
  sum.add_product(c.y(), b.x());
  return sum.sign_of_sum();
}

}  // namespace gsp
