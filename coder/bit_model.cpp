#include "coder/bit_model.h"

#include <algorithm>

namespace gsp {

namespace {

/// 65536 / (1 + exp(-x)) at x = -11, -10.5, ..., 11. Constants, so that no mathematical library's last bit can matter.
constexpr int kKnots = 45;
constexpr int kKnotSpacing = 128;
constexpr int kLargestLogit = 11 * 256;
constexpr std::array<int, kKnots> kLogistic = {
    1,     2,     3,     5,     8,     13,    22,    36,    60,    98,    162,   267,   439,   720,   1179,
    1921,  3108,  4971,  7812,  11955, 17625, 24743, 32768, 40793, 47911, 53581, 57724, 60565, 62428, 63615,
    64357, 64816, 65097, 65269, 65374, 65438, 65476, 65500, 65514, 65523, 65528, 65531, 65533, 65534, 65535};

constexpr int interpolate(int logit) {
  const int offset = logit + kLargestLogit;
  const int knot = offset / kKnotSpacing, rest = offset % kKnotSpacing;
  if (rest == 0) return kLogistic[knot];
  return kLogistic[knot] + ((kLogistic[knot + 1] - kLogistic[knot]) * rest + kKnotSpacing / 2) / kKnotSpacing;
}

struct Tables {
  std::array<std::uint16_t, 2 * kLargestLogit + 1> squash;
  std::array<std::int16_t, 4096> stretch;

  Tables() {
    for (int x = -kLargestLogit; x <= kLargestLogit; ++x)
      squash[x + kLargestLogit] = static_cast<std::uint16_t>(std::clamp(interpolate(x), 1, 65535));
    int x = -kLargestLogit;
    for (int p = 0; p < 4096; ++p) {
      while (x < kLargestLogit && squash[x + kLargestLogit] < 16 * p + 8) ++x;
      stretch[p] = static_cast<std::int16_t>(x);
    }
  }
};

const Tables tables;

/// 65536 / (n + 1.5): the step that keeps a running mean.
const auto reciprocals = [] {
  std::array<std::int32_t, 1024> r;
  for (int n = 0; n < 1024; ++n) r[n] = 2 * 65536 / (2 * n + 3);
  return r;
}();

}  // namespace

void AdaptiveBit::update(bool bit, int limit) {
  const int target = bit ? 65535 : 0;
  const int step = static_cast<int>((static_cast<std::int64_t>(target - set) * reciprocals[seen]) >> 16);
  set = static_cast<std::uint16_t>(std::clamp(set + step, 32, 65535 - 32));
  if (seen < limit) ++seen;
}

int stretch(Probability set) { return tables.stretch[set >> 4]; }

Probability squash(int logit) {
  return tables.squash[std::clamp(logit, -kLargestLogit, kLargestLogit) + kLargestLogit];
}

}  // namespace gsp
