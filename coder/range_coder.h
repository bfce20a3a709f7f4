#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gsp {

/// Probability of a set bit in 1/65536, 1..65535.
using Probability = std::uint32_t;

/// Binary range coder without carries: the interval's common leading bytes are written as soon as they are settled, so
/// that every prefix of the output pins down every decision it can (Martin 1979, in the 64-bit bounds form of PAQ).
class RangeEncoder {
 public:
  /// Appends to `out`, which must outlive the encoder.
  explicit RangeEncoder(std::vector<std::uint8_t>& out) : out_(out) {}

  void encode(bool bit, Probability set) {
    const std::uint64_t middle = low_ + ((high_ - low_) >> 16) * set;
    if (bit)
      high_ = middle;
    else
      low_ = middle + 1;
    while ((low_ ^ high_) >> 56 == 0) shift_out();
  }

  /// Writes the fewest bytes after which every decision is settled whatever follows.
  void finish() {
    const auto lies_within = [&](int bytes) {
      const std::uint64_t tail = bytes == 8 ? 0 : ~0ULL >> (8 * bytes);
      const std::uint64_t start = (low_ + tail) & ~tail;
      return start >= low_ && start + tail <= high_ && start + tail >= start;
    };
    int bytes = 1;
    while (bytes < 8 && !lies_within(bytes)) ++bytes;
    const std::uint64_t tail = bytes == 8 ? 0 : ~0ULL >> (8 * bytes);
    const std::uint64_t start = (low_ + tail) & ~tail;
    for (int b = 0; b < bytes; ++b) out_.push_back(static_cast<std::uint8_t>(start >> (56 - 8 * b)));
  }

 private:
  void shift_out() {
    out_.push_back(static_cast<std::uint8_t>(high_ >> 56));
    low_ <<= 8;
    high_ = (high_ << 8) | 0xff;
  }

  std::vector<std::uint8_t>& out_;
  std::uint64_t low_ = 0;
  std::uint64_t high_ = ~0ULL;
};

/// Thrown by RangeDecoder at the first decision that its bytes do not settle.
struct StreamEnd {};

/// The inverse. Past its last byte it goes on for as long as all continuations agree, then throws StreamEnd, so a
/// prefix yields exactly the decisions that it determines and never a guess.
class RangeDecoder {
 public:
  RangeDecoder(const std::uint8_t* begin, const std::uint8_t* end) : next_(begin), end_(end) {
    for (int b = 0; b < 8; ++b) shift_in();
  }

  bool decode(Probability set) {
    const std::uint64_t middle = low_ + ((high_ - low_) >> 16) * set;
    const bool bit = code_ <= middle;
    if (((code_ | unknown_) <= middle) != bit) throw StreamEnd{};
    if (bit)
      high_ = middle;
    else
      low_ = middle + 1;
    while ((low_ ^ high_) >> 56 == 0) {
      low_ <<= 8;
      high_ = (high_ << 8) | 0xff;
      shift_in();
    }
    return bit;
  }

 private:
  void shift_in() {
    const bool known = next_ != end_;
    code_ = (code_ << 8) | (known ? *next_++ : 0);
    unknown_ = (unknown_ << 8) | (known ? 0x00 : 0xff);
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
  std::uint64_t low_ = 0;
  std::uint64_t high_ = ~0ULL;
  std::uint64_t code_ = 0;
  std::uint64_t unknown_ = 0;  ///< ones over the bits of `code_` that lie past the end
};

}  // namespace gsp
