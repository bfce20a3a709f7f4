#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

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

/// One kind of decision, predicted by N contexts at once, whose opinions are weighed in the logistic domain by weights
/// that are learned on line (Mahoney, "Adaptive weighing of context models for lossless data compression", 2005).
template <int N>
class MixedModel {
 public:
  /// `sizes`: number of values of each context; `mixers`: number of weight sets.
  MixedModel(const std::array<int, N>& sizes, int mixers) : weights_(mixers) {
    for (int i = 0; i < N; ++i) contexts_[i].resize(sizes[i]);
    for (auto& weights : weights_) weights.fill(65536 * 3 / (2 * N));
  }

  /// Codes `actual` through `side`, or receives it from there, and learns from it.
  template <class Side>
  bool decide(Side& side, bool actual, const std::array<int, N>& context, int mixer) {
    std::array<int, N> logits;
    std::int64_t sum = 0;
    auto& weights = weights_[mixer];
    for (int i = 0; i < N; ++i) {
      logits[i] = stretch(contexts_[i][context[i]].set);
      sum += static_cast<std::int64_t>(weights[i]) * logits[i];
    }
    const Probability predicted = std::clamp<Probability>(squash(static_cast<int>(sum >> 16)), 16, 65536 - 16);
    const bool bit = side.decide(actual, predicted);
    const std::int64_t error = (bit ? 65535 : 0) - static_cast<std::int64_t>(predicted);
    for (int i = 0; i < N; ++i) {
      weights[i] += static_cast<std::int32_t>((logits[i] * error * kLearningRate) >> 16);
      contexts_[i][context[i]].update(bit, kMemory);
    }
    return bit;
  }

 private:
  static constexpr int kMemory = 400;  // bits after which a context starts to forget
  static constexpr int kLearningRate = 2;

  std::array<std::vector<AdaptiveBit>, N> contexts_;
  std::vector<std::array<std::int32_t, N>> weights_;
};

}  // namespace gsp
