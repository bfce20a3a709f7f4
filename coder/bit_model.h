#pragma once

#include <array>
#include <cstdint>

#include "coder/range_coder.h"

namespace gsp {

/// Adaptive probability of one context: the mean of the bits seen, forgetting slowly once it has seen enough.
struct AdaptiveBit {
  std::uint16_t set = 32768;  ///< probability of a set bit in 1/65536
  std::uint16_t seen = 0;

  void update(bool bit, int limit);
};

/// Logistic functions in integers, the same on every machine: `stretch` is ln(p/(1-p)) in 1/256, `squash` its inverse.
int stretch(Probability set);
Probability squash(int logit);

/// Weighs the predictions of several contexts in the logistic domain and learns the weights on line
/// (Mahoney, "Adaptive weighing of context models", 2005).
template <int N>
struct Mixer {
  std::array<std::int32_t, N> weight;  ///< in 1/65536

  Mixer() { weight.fill(65536 * 6 / (5 * N)); }

  Probability mix(const std::array<int, N>& logit) const {
    std::int64_t sum = 0;
    for (int i = 0; i < N; ++i) sum += static_cast<std::int64_t>(weight[i]) * logit[i];
    return squash(static_cast<int>(sum >> 16));
  }

  void update(const std::array<int, N>& logit, Probability predicted, bool bit, int rate) {
    const int error = (bit ? 65535 : 0) - static_cast<int>(predicted);
    for (int i = 0; i < N; ++i)
      weight[i] += static_cast<std::int32_t>((static_cast<std::int64_t>(logit[i]) * error * rate) >> 16);
  }
};

}  // namespace gsp
