#pragma once

#include <algorithm>
#include <cstdint>

#include "coder/range_coder.h"
#include "mesh/error.h"

namespace gsp {

/// Notices damage in a stream's payload: now and then a byte says what the decisions before it came to. One comes with
/// every 4096 events (some 3 KB), later with every eighth of them, 20 bytes in 60 KB; a damaged stream passes one by
/// chance once in 256 times, and hardly ever two.
class PayloadCheck {
 public:
  /// `event`: what the side that decodes has just learnt.
  void note(std::uint32_t event) {
    hash_ = (hash_ ^ event) * 0x9e3779b1u;
    hash_ ^= hash_ >> 15;
    ++since_;
  }

  /// Codes a check through `side` if one is due. Throws Error(BadStream) where the byte that is read is another one.
  template <class Side>
  void check_if_due(Side& side) {
    if (since_ < std::max(kLeastEvents, total_ / 8)) return;
    total_ += since_;
    since_ = 0;
    const std::uint32_t expected = hash_ >> 24;
    std::uint32_t found = 0;
    for (int b = 0; b < 8; ++b) found |= static_cast<std::uint32_t>(side.decide(expected >> b & 1, kEven)) << b;
    if (found != expected) throw Error(Cause::BadStream, "the payload of the coded mesh is damaged");
  }

 private:
  static constexpr std::uint32_t kLeastEvents = 4096;
  static constexpr Probability kEven = 32768;
  std::uint32_t hash_ = 0, since_ = 0, total_ = 0;
};

}  // namespace gsp
