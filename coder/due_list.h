#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace gsp {

/// For each of many things the pass in which it is due, where passes count down. Few are due in any pass, so things are
/// looked through in blocks whose latest pass is known.
class DueList {
 public:
  using Pass = std::uint8_t;
  static constexpr Pass kNever = 0;

  explicit DueList(std::size_t size)
      : due_((size + kBlock - 1) / kBlock * kBlock, kNever), latest_(due_.size() / kBlock) {}

  Pass operator[](int i) const { return due_[i]; }

  void set(int i, Pass pass) {
    due_[i] = pass;
    Pass& latest = latest_[i / kBlock];
    latest = std::max(latest, pass);
  }

  /// Visits in order all i in [begin, end) that are due in `pass` > kNever or were before; visit(i) returns when i is
  /// due next. What falls due inside a block that has been begun waits for the next pass.
  template <class Visit>
  void for_each_due(int begin, int end, Pass pass, Visit visit) {
    for (int block = begin / kBlock; block * kBlock < end; ++block) {
      if (latest_[block] < pass) continue;
      const int first = block * kBlock;
      std::uint32_t now = due_bits(&due_[first], pass);
      if (first < begin) now &= ~0u << (begin - first);
      if (end - first < kBlock) now &= (1u << (end - first)) - 1;
      if (now == 0) continue;
      for (; now != 0; now &= now - 1) {
        const int i = first + std::countr_zero(now);
        const Pass next = visit(i);
        due_[i] = next;
      }
      Pass latest = kNever;
      for (int i = 0; i < kBlock; ++i) latest = std::max(latest, due_[first + i]);
      latest_[block] = latest;
    }
  }

 private:
  static constexpr int kBlock = 32;

  /// Bit i: block[i] is due. Each product gathers eight bytes of 0 or 1 in its highest byte.
  static std::uint32_t due_bits(const Pass* block, Pass pass) {
    static_assert(std::endian::native == std::endian::little && kBlock == 32);
    std::array<std::uint8_t, kBlock> is_due;
    for (int i = 0; i < kBlock; ++i) is_due[i] = block[i] >= pass;
    std::uint32_t bits = 0;
    for (int k = 0; k < kBlock / 8; ++k) {
      std::uint64_t eight;
      std::memcpy(&eight, is_due.data() + 8 * k, sizeof eight);
      bits |= static_cast<std::uint32_t>(eight * 0x0102040810204080 >> 56) << 8 * k;
    }
    return bits;
  }

  std::vector<Pass> due_;
  std::vector<Pass> latest_;  ///< of each block, at least
};

}  // namespace gsp
