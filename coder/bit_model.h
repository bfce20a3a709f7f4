#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "coder/range_coder.h"

namespace gsp {

/// Logistic functions in integers, the same on every machine: `stretch` is ln(p/(1-p)) in 1/256, `squash` its inverse.
class Logistic {
 public:
  static int stretch(Probability set) { return tables.stretch[set >> 4]; }
  static Probability squash(int logit) {
    return tables.squash[std::clamp(logit, -kLargestLogit, kLargestLogit) + kLargestLogit];
  }

  /// The same, at least 16 away from both ends: what a mixed model may be sure of.
  static Probability safe_squash(int logit) {
    return tables.safe_squash[std::clamp(logit, -kLargestLogit, kLargestLogit) + kLargestLogit];
  }

  static constexpr int kLargestLogit = 11 * 256;
  struct Tables {
    std::array<std::uint16_t, 2 * kLargestLogit + 1> squash, safe_squash;
    std::array<std::int16_t, 4096> stretch;
  };

 private:
  static const Tables tables;
};

/// Adaptive probability of one context: the mean of the bits seen, forgetting slowly once it has seen enough.
struct AdaptiveBit {
  std::uint16_t set = 32768;  ///< probability of a set bit in 1/65536
  std::uint16_t seen = 0;

  static constexpr int kMostMemory = 1023;

  /// `memory`: bits after which the context starts to forget, at most kMostMemory.
  void update(bool bit, int memory) {
    const int target = bit ? 65535 - kLeast : kLeast;
    set += static_cast<std::uint16_t>((target - set) * kShares[seen] >> 15);
    seen += seen < memory;
  }

 private:
  static constexpr int kLeast = 32;  ///< no bit is surer than this in 1/65536
  /// 32768 / (n + 1.5): the step that keeps a running mean.
  static constexpr auto kShares = [] {
    std::array<std::int32_t, kMostMemory + 1> shares{};
    for (int n = 0; n <= kMostMemory; ++n) shares[n] = (2 * 65536 / (2 * n + 3) + 1) / 2;
    return shares;
  }();
};

/// A context that has seen a few bits of that probability.
inline AdaptiveBit expecting(double probability) { return {static_cast<std::uint16_t>(65536 * probability), 4}; }

/// One kind of decision, predicted by N contexts at once, whose opinions are weighed in the logistic domain by weights
/// that are learned on line (Mahoney, "Adaptive weighing of context models for lossless data compression", 2005).
/// `Mixers`: number of weight sets; `Sizes`: number of values of each context.
template <int Mixers, int... Sizes>
class MixedModel {
 public:
  static constexpr int N = sizeof...(Sizes);

  MixedModel() {
    for (auto& weights : weights_) weights.fill(65536 * 3 / (2 * N));
  }

  /// Codes `actual` through `side`, or receives it from there, and learns from it.
  template <class Side>
  bool decide(Side& side, bool actual, const std::array<int, N>& context, int mixer) {
    std::array<AdaptiveBit*, N> bits;
    std::array<int, N> logits;
    std::int64_t sum = 0;
    auto& weights = weights_[mixer];
    for (int i = 0; i < N; ++i) {
      bits[i] = &contexts_[kFirst[i] + context[i]];
      logits[i] = Logistic::stretch(bits[i]->set);
      sum += static_cast<std::int64_t>(weights[i]) * logits[i];
    }
    const Probability predicted = Logistic::safe_squash(static_cast<int>(sum >> 16));
    const bool bit = side.decide(actual, predicted);
    const int error = (bit ? 65535 : 0) - static_cast<int>(predicted);
    for (int i = 0; i < N; ++i) {
      weights[i] += (logits[i] * error) >> (16 - kLearningShift);
      bits[i]->update(bit, kMemory);
    }
    return bit;
  }

 private:
  static constexpr int kMemory = 400;
  static constexpr int kLearningShift = 1;

  static constexpr std::array<int, N> kFirst = [] {
    constexpr std::array<int, N> kSizes = {Sizes...};
    std::array<int, N> first{};
    for (int i = 1; i < N; ++i) first[i] = first[i - 1] + kSizes[i - 1];
    return first;
  }();

  std::array<AdaptiveBit, (Sizes + ...)> contexts_;  ///< all values of the first context, then those of the next
  std::array<std::array<std::int32_t, N>, Mixers> weights_;
};

}  // namespace gsp
