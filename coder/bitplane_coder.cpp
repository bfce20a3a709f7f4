#include "coder/bitplane_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "coder/bit_model.h"
#include "coder/range_coder.h"

namespace gsp {

namespace {

constexpr int kInputs = 4;
constexpr int kMemory = 250;     // bits after which a context starts to forget
constexpr int kMixerRate = 6;

/// Several contexts' opinions on one decision, mixed.
class Decision {
 public:
  Decision(Mixer<kInputs>& mixer, const std::array<AdaptiveBit*, kInputs>& contexts) : mixer_(mixer), contexts_(contexts) {
    for (int i = 0; i < kInputs; ++i) logits_[i] = stretch(contexts_[i]->set);
    probability_ = std::clamp<Probability>(mixer_.mix(logits_), 16, 65536 - 16);
  }
  Probability probability() const { return probability_; }
  void learn(bool bit) {
    mixer_.update(logits_, probability_, bit, kMixerRate);
    for (AdaptiveBit* context : contexts_) context->update(bit, kMemory);
  }

 private:
  Mixer<kInputs>& mixer_;
  const std::array<AdaptiveBit*, kInputs>& contexts_;
  std::array<int, kInputs> logits_;
  Probability probability_;
};

struct ContextSet {
  std::vector<AdaptiveBit> bits;
  AdaptiveBit* at(std::size_t i) { return &bits[i]; }
  explicit ContextSet(std::size_t n) : bits(n) {}
};

class EncodingSide {
 public:
  explicit EncodingSide(Bytes& out) : coder_(out) {}
  bool decide(bool actual, Probability set) {
    coder_.encode(actual, set);
    return actual;
  }
  void finish() { coder_.finish(); }

 private:
  RangeEncoder coder_;
};

class DecodingSide {
 public:
  DecodingSide(const std::uint8_t* begin, const std::uint8_t* end) : coder_(begin, end) {}
  bool decide(bool, Probability set) { return coder_.decode(set); }

 private:
  RangeDecoder coder_;
};

/// 0, 1, 2, 3-4, 5-8, ... in quarters of the plane's threshold.
int magnitude_class(std::uint64_t quarters, int classes) {
  return std::min<int>(std::bit_width(quarters), classes - 1);
}

template <class Side>
class BitplaneCoder {
 public:
  BitplaneCoder(const EdgeForest& forest, const BitplaneLayout& layout, const BitplaneCoefficients* actual, Side& side)
      : forest_(forest), layout_(layout), actual_(actual), side_(side) {
    const std::size_t vertices = layout.base_neighbours.size(), nodes = forest.nodes();
    known_.base.assign(vertices, {0, 0, 0});
    known_.base_low_plane.assign(vertices, {});
    for (auto& planes : known_.base_low_plane) planes.fill(layout.base_planes);
    for (int c = 0; c < 3; ++c) {
      known_.details[c].magnitude.assign(nodes, 0);
      known_.details[c].negative.assign(nodes, 0);
      known_.details[c].low_plane.assign(nodes, layout.detail_planes);
      descendants_[c].assign(nodes, 0);
      descendants_low_plane_[c].assign(nodes, layout.detail_planes);
    }
    if (actual) find_largest_descendants();
  }

  void run() {
    const int top = kPassesPerPlane * std::max(layout_.base_planes, layout_.detail_planes) - 1 + kMaxUrgency;
    for (int pass = top; pass >= kMaxUrgency; --pass) {
      if (pass % kPassesPerPlane == kPassesPerPlane - 1) urgency_ = layout_.urgency(known_);
      const int base_plane = (pass + kPassesPerPlane - 1) / kPassesPerPlane;
      if (pass % kPassesPerPlane == 0 && base_plane < layout_.base_planes) base_pass(base_plane);
      for (int level = 0; level < forest_.levels(); ++level)
        for (int c = 0; c < 3; ++c) detail_pass(pass, level, c);
    }
  }

  BitplaneCoefficients take() { return std::move(known_); }

 private:
  void find_largest_descendants() {
    for (int c = 0; c < 3; ++c) {
      largest_[c].assign(forest_.nodes(), 0);
      for (int n = forest_.nodes() - 1; n >= 0; --n) {
        const int parent = forest_.parent[n];
        if (parent < 0) continue;
        const std::uint32_t below = std::max(largest_[c][n], actual_->details[c].magnitude[n]);
        largest_[c][parent] = std::max(largest_[c][parent], below);
      }
    }
  }

  bool decide(bool actual, Mixer<kInputs>& mixer, const std::array<AdaptiveBit*, kInputs>& contexts) {
    Decision decision(mixer, contexts);
    const bool bit = side_.decide(actual, decision.probability());
    decision.learn(bit);
    return bit;
  }

  double base_midpoint(int v, int k) const {
    return known_.base[v][k] + 0.5 * static_cast<double>(1u << known_.base_low_plane[v][k]);
  }

  /// The next bit of every base coordinate. Its context is where the neighbours' mean, as far as known, lies in the
  /// interval that the bit halves: prediction from all sides, without the noise of a transform.
  void base_pass(int plane) {
    const double unit = static_cast<double>(1u << plane);
    for (std::size_t v = 0; v < known_.base.size(); ++v) {
      for (int k = 0; k < 3; ++k) {
        const std::vector<int>& ring = layout_.base_neighbours[v];
        double mean = 0.0, spread = 0.0;
        for (int w : ring) mean += base_midpoint(w, k);
        mean /= std::max<std::size_t>(ring.size(), 1);
        for (int w : ring) spread += std::abs(base_midpoint(w, k) - mean);
        spread /= std::max<std::size_t>(ring.size(), 1);
        const double x = (mean - known_.base[v][k] - unit) / unit;
        const int place = static_cast<int>(std::clamp(std::floor(x * 4.0), -8.0, 7.0)) + 8;
        const int width = magnitude_class(static_cast<std::uint64_t>(4.0 * spread / unit), 8);
        const int fine = static_cast<int>(std::clamp(std::floor(x * 12.0), -16.0, 15.0)) + 16;
        const std::array<AdaptiveBit*, kInputs> contexts = {
            base_a_.at(place), base_b_.at(place * 8 + width), base_c_.at(fine), base_d_.at(place / 2 * 32 + plane)};
        const bool bit = decide(actual_ && (actual_->base[v][k] >> plane & 1), base_mixer_, contexts);
        known_.base[v][k] |= static_cast<std::uint32_t>(bit) << plane;
        known_.base_low_plane[v][k] = plane;
      }
    }
  }

  void detail_pass(int pass, int level, int c) {
    auto& known = known_.details[c];
    for (int n = forest_.level_begin[level]; n < forest_.level_begin[level + 1]; ++n) {
      const int last = (pass - urgency_[n] + kPassesPerPlane - 1) / kPassesPerPlane;
      while (known.low_plane[n] > last) {
        const int plane = known.low_plane[n] - 1;
        const int parent = forest_.parent[n];
        if (parent < 0 || has_descendants(plane, level - 1, c, parent)) {
          if (known.magnitude[n] != 0)
            refine(plane, level, c, n);
          else
            find_significant(plane, level, c, n);
        }
        known.low_plane[n] = plane;
      }
    }
  }

  /// Whether a descendant of `n` is significant at `plane`, asked from the stream where it is not known yet.
  bool has_descendants(int plane, int level, int c, int n) {
    std::uint8_t& low_plane = descendants_low_plane_[c][n];
    while (!descendants_[c][n] && low_plane > plane) {
      const int parent = forest_.parent[n];
      if (parent < 0 || has_descendants(low_plane - 1, level - 1, c, parent)) find_descendants(low_plane - 1, level, c, n);
      --low_plane;
    }
    return descendants_[c][n];
  }

  /// Sum over the same-level neighbours' magnitudes in quarters of the threshold.
  std::uint64_t ring(int plane, int c, int n) const {
    std::uint64_t sum = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) sum += known_.details[c].magnitude[w];
    return quarters(sum, plane);
  }
  static std::uint64_t quarters(std::uint64_t magnitude, int plane) { return (magnitude << 2) >> plane; }

  void find_significant(int plane, int level, int c, int n) {
    const int type = c == 0 ? 0 : 1;
    const int parent = forest_.parent[n];
    const auto& known = known_.details[c];
    const std::uint64_t around = ring(plane, c, n);
    const std::uint64_t above = parent < 0 ? 0 : quarters(known.magnitude[parent], plane);
    std::uint64_t others = 0;
    for (int o = 0; o < 3; ++o)
      if (o != c) others += quarters(known_.details[o].magnitude[n], plane);
    std::uint64_t wide = around * 2 + above;
    for (int w : forest_.neighbours[n])
      if (w >= 0) wide += ring(plane, c, w);
    const int qa = magnitude_class(around, 8), qb = magnitude_class(above, 7), qo = magnitude_class(others, 6);
    const int qw = magnitude_class(wide, 10);
    const int beneath = descendants_[c][n];
    const std::array<AdaptiveBit*, kInputs> contexts = {
        significance_a_.at(((type * 8 + qa) * 7 + qb) * 2 + beneath),
        significance_b_.at((level * 32 + plane) * 3 + c),
        significance_c_.at(((c * 6 + qo) * 8 + qa) * 2 + beneath),
        significance_d_.at((type * 10 + qw) * 12 + level)};
    const bool bit = decide(actual_ && (actual_->details[c].magnitude[n] >> plane & 1), significance_mixer_[type], contexts);
    if (!bit) return;
    const bool negative = side_.decide(actual_ && actual_->details[c].negative[n], 32768);
    known_.details[c].magnitude[n] = 1u << plane;
    known_.details[c].negative[n] = negative;
  }

  void refine(int plane, int level, int c, int n) {
    const int type = c == 0 ? 0 : 1;
    auto& known = known_.details[c];
    const int first = std::min<int>(std::bit_width(known.magnitude[n] >> (plane + 1)), 4);
    const int qa = magnitude_class(ring(plane, c, n), 8);
    const std::array<AdaptiveBit*, kInputs> contexts = {refinement_a_.at(first * 8 + qa), refinement_b_.at(first * 2 + type),
                                                        refinement_c_.at(level * 5 + first), refinement_d_.at(plane * 5 + first)};
    const bool bit = decide(actual_ && (actual_->details[c].magnitude[n] >> plane & 1), refinement_mixer_, contexts);
    known.magnitude[n] |= static_cast<std::uint32_t>(bit) << plane;
  }

  void find_descendants(int plane, int level, int c, int n) {
    const int type = c == 0 ? 0 : 1;
    const int parent = forest_.parent[n];
    const auto& known = known_.details[c];
    const int qs = magnitude_class(quarters(known.magnitude[n], plane), 6);
    const int qa = magnitude_class(ring(plane, c, n), 8);
    int nearby = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) nearby += descendants_[c][w];
    const int qp = parent < 0 ? 0 : magnitude_class(quarters(known.magnitude[parent], plane), 6);
    int other = 0;
    for (int o = 0; o < 3; ++o)
      if (o != c) other += descendants_[o][n];
    const std::array<AdaptiveBit*, kInputs> contexts = {
        descendants_a_.at((type * 6 + qs) * 8 + qa), descendants_b_.at((level * 32 + plane) * 3 + c),
        descendants_c_.at(((c * 5 + nearby) * 3 + other) * 6 + qs), descendants_d_.at((type * 6 + qp) * 12 + level)};
    const bool bit = decide(actual_ && largest_[c][n] >> plane != 0, descendants_mixer_[type], contexts);
    descendants_[c][n] = bit;
  }

  const EdgeForest& forest_;
  const BitplaneLayout& layout_;
  const BitplaneCoefficients* actual_;
  Side& side_;
  BitplaneCoefficients known_;
  std::array<std::vector<std::uint8_t>, 3> descendants_;  ///< 1 once a descendant is significant
  std::array<std::vector<std::uint8_t>, 3> descendants_low_plane_;  ///< planes from here up are known to have none before
  std::array<std::vector<std::uint32_t>, 3> largest_;
  std::vector<std::int8_t> urgency_;

  ContextSet base_a_{16}, base_b_{16 * 8}, base_c_{32}, base_d_{8 * 32};
  Mixer<kInputs> base_mixer_;
  ContextSet significance_a_{2 * 8 * 7 * 2}, significance_b_{12 * 32 * 3}, significance_c_{3 * 6 * 8 * 2},
      significance_d_{2 * 10 * 12};
  std::array<Mixer<kInputs>, 2> significance_mixer_;
  ContextSet refinement_a_{5 * 8}, refinement_b_{5 * 2}, refinement_c_{12 * 5}, refinement_d_{32 * 5};
  Mixer<kInputs> refinement_mixer_;
  ContextSet descendants_a_{2 * 6 * 8}, descendants_b_{12 * 32 * 3}, descendants_c_{3 * 5 * 3 * 6}, descendants_d_{2 * 6 * 12};
  std::array<Mixer<kInputs>, 2> descendants_mixer_;
};

}  // namespace

void encode_bitplanes(const EdgeForest& forest, const BitplaneLayout& layout, const BitplaneCoefficients& coefficients,
                      Bytes& out) {
  EncodingSide side(out);
  BitplaneCoder<EncodingSide> coder(forest, layout, &coefficients, side);
  coder.run();
  side.finish();
}

BitplaneCoefficients decode_bitplanes(const EdgeForest& forest, const BitplaneLayout& layout, const std::uint8_t* begin,
                                      const std::uint8_t* end) {
  DecodingSide side(begin, end);
  BitplaneCoder<DecodingSide> coder(forest, layout, nullptr, side);
  try {
    coder.run();
  } catch (const StreamEnd&) {
    // A prefix: everything before the first undetermined decision is known.
  }
  return coder.take();
}

}  // namespace gsp
