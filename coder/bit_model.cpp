#include "coder/bit_model.h"

namespace gsp {

namespace {

/// 65536 / (1 + exp(-x)) at x = -11, -10.5, ..., 11. Constants, so that no mathematical library's last bit can matter.
constexpr int kKnots = 45;
constexpr int kKnotSpacing = 128;
constexpr std::array<int, kKnots> kLogistic = {
    1,     2,     3,     5,     8,     13,    22,    36,    60,    98,    162,   267,   439,   720,   1179,
    1921,  3108,  4971,  7812,  11955, 17625, 24743, 32768, 40793, 47911, 53581, 57724, 60565, 62428, 63615,
    64357, 64816, 65097, 65269, 65374, 65438, 65476, 65500, 65514, 65523, 65528, 65531, 65533, 65534, 65535};

constexpr int interpolate(int offset) {
  const int knot = offset / kKnotSpacing, rest = offset % kKnotSpacing;
  if (rest == 0) return kLogistic[knot];
  return kLogistic[knot] + ((kLogistic[knot + 1] - kLogistic[knot]) * rest + kKnotSpacing / 2) / kKnotSpacing;
}

constexpr Logistic::Tables make_tables() {
  Logistic::Tables tables{};
  constexpr int kLast = 2 * Logistic::kLargestLogit;
  for (int i = 0; i <= kLast; ++i) {
    tables.squash[i] = static_cast<std::uint16_t>(std::clamp(interpolate(i), 1, 65535));
    tables.safe_squash[i] = static_cast<std::uint16_t>(std::clamp(interpolate(i), 16, 65536 - 16));
  }
  int i = 0;
  for (int p = 0; p < 4096; ++p) {
    while (i < kLast && tables.squash[i] < 16 * p + 8) ++i;
    tables.stretch[p] = static_cast<std::int16_t>(i - Logistic::kLargestLogit);
  }
  return tables;
}

}  // namespace

constinit const Logistic::Tables Logistic::tables = make_tables();

}  // namespace gsp
