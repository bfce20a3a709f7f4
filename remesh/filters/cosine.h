#pragma once

namespace gsp {

/// cos(2π·numerator / denominator) by additions, multiplications and one division alone, in a fixed order: the same
/// bits on every machine, which a mathematical library's are not. 0 <= numerator <= denominator < 2^30. Off by 2^-52 at
/// most; exact at multiples of a quarter turn.
constexpr double cosine_of_turn(int numerator, int denominator) {
  constexpr double kTurn = 6.283185307179586476925;
  long long p = numerator, q = denominator;
  if (2 * p > q) p = q - p;
  // cos(½ turn - x) = -cos(x).
  const double sign = 4 * p > q ? -1.0 : 1.0;
  if (sign < 0.0) p = q - 2 * p, q *= 2;
  // cos(¼ turn - x) = sin(x); what is left is at most an eighth of a turn.
  const bool sine = 8 * p > q;
  if (sine) p = q - 4 * p, q *= 4;
  const double x = kTurn * static_cast<double>(p) / static_cast<double>(q), square = x * x;
  // Taylor's series, of which the terms left out are under 2^-60.
  double sum = 1.0;
  for (int n = 16; n > 0; n -= 2) {
    const int last = sine ? n + 1 : n;
    sum = 1.0 - square / (static_cast<double>(last) * (last - 1)) * sum;
  }
  return sign * (sine ? x * sum : sum);
}

}  // namespace gsp
