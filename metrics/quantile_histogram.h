#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gsp {

/// Weighted quantiles of non-negative numbers that many threads add: bins are the leading bits of the number as a
/// float, so each is 2^-11 of its value wide, and weights are summed as integers, so the order of adding does not
/// matter.
class QuantileHistogram {
 public:
  /// Numbers are taken relative to `unit` > 0; those under 1e-38 of it count as none.
  explicit QuantileHistogram(double unit) : unit_(unit > 0.0 ? unit : 1.0), bins_(kBins) {}

  /// `weight` in [0, 16]; up to 1e9 of them. Any thread.
  void add(double value, double weight) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value / unit_));
    bins_[std::min(bits >> kDropped, kBins - 1)].fetch_add(static_cast<std::uint64_t>(weight * kOne + 0.5),
                                                           std::memory_order_relaxed);
  }

  /// The value below which `share` of the weight lies, linear within a bin; 0 where nothing was added.
  double quantile(double share) const {
    double total = 0.0, below = 0.0;
    for (const auto& bin : bins_) total += static_cast<double>(bin.load());
    for (std::uint32_t b = 0; b + 1 < kBins; ++b) {
      const auto weight = static_cast<double>(bins_[b].load());
      if (weight == 0.0 || below + weight < share * total) {
        below += weight;
        continue;
      }
      const double low = std::bit_cast<float>(b << kDropped), high = std::bit_cast<float>((b + 1) << kDropped);
      return unit_ * (low + (high - low) * (share * total - below) / weight);
    }
    return 0.0;
  }

 private:
  static constexpr int kDropped = 12;
  static constexpr std::uint32_t kBins = 0x7f800000u >> kDropped;  ///< up to the largest finite float
  static constexpr double kOne = 1 << 20;

  double unit_;
  std::vector<std::atomic<std::uint64_t>> bins_;
};

}  // namespace gsp
