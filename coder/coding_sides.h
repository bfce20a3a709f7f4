#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coder/bitplane_coder.h"
#include "coder/range_coder.h"

namespace gsp {

// The ends of the stream at which the bit-plane coder runs: the same decisions, written, priced or read.

/// Bits that a decision of probability (i + 1/2) / 4096 takes.
inline const auto costs = [] {
  std::array<float, 4097> bits;
  for (int i = 0; i <= 4096; ++i) bits[i] = static_cast<float>(12.0 - std::log2(i + 0.5));
  return bits;
}();

class EncodingSide {
 public:
  explicit EncodingSide(Bytes& out) : coder_(out) {}
  bool decide(bool actual, Probability set) {
    set_ = set;
    coder_.encode(actual, set);
    *count_ += costs[(actual ? set : 65536 - set) >> 4];
    return actual;
  }
  /// Where the next decisions are counted.
  void count_as(double BitplaneParts::Component::*kind, int c) { count_ = &(parts_.details[c].*kind); }
  void count_as_base() { count_ = &parts_.base; }
  void count_as_check() { count_ = &parts_.checks; }
  const BitplaneParts& parts() const { return parts_; }
  void finish() { coder_.finish(); }
  void note_significance(int, int) {}

 protected:
  Probability set_ = 0;  ///< of the last decision

 private:
  RangeEncoder coder_;
  BitplaneParts parts_;
  double* count_ = &parts_.base;
};

/// Writes up to a size, and notes what decisions would have cost.
class PricingSide : public EncodingSide {
 public:
  PricingSide(Bytes& out, std::size_t limit, std::size_t nodes) : EncodingSide(out), out_(out), limit_(limit) {
    for (auto& component : prices) component.assign(nodes, BitplaneState::kNoPrice);
  }
  bool decide(bool actual, Probability set) {
    if (out_.size() >= limit_) throw StreamEnd{};
    return EncodingSide::decide(actual, set);
  }
  void note_significance(int c, int n) { prices[c][n] = costs[set_ >> 4] - costs[(65536 - set_) >> 4] + 1.0f; }

  std::array<std::vector<float>, 3> prices;

 private:
  const Bytes& out_;
  std::size_t limit_;
};

class DecodingSide {
 public:
  DecodingSide(const std::uint8_t* begin, const std::uint8_t* end) : coder_(begin, end) {}
  bool decide(bool, Probability set) { return coder_.decode(set); }
  void count_as(double BitplaneParts::Component::*, int) {}
  void count_as_base() {}
  void count_as_check() {}
  void note_significance(int, int) {}

 private:
  RangeDecoder coder_;
};

}  // namespace gsp
