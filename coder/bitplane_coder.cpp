#include "coder/bitplane_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "coder/bit_model.h"
#include "coder/range_coder.h"

namespace gsp {

namespace {

/// Bits that a decision of probability (i + 1/2) / 4096 takes.
const auto costs = [] {
  std::array<float, 4097> bits;
  for (int i = 0; i <= 4096; ++i) bits[i] = static_cast<float>(12.0 - std::log2(i + 0.5));
  return bits;
}();

class EncodingSide {
 public:
  explicit EncodingSide(Bytes& out) : coder_(out) {}
  bool decide(bool actual, Probability set) {
    coder_.encode(actual, set);
    *count_ += costs[(actual ? set : 65536 - set) >> 4];
    return actual;
  }
  /// Where the next decisions are counted.
  void count_as(double BitplaneParts::Component::*kind, int c) { count_ = &(parts_.details[c].*kind); }
  void count_as_base() { count_ = &parts_.base; }
  const BitplaneParts& parts() const { return parts_; }
  void finish() { coder_.finish(); }

 private:
  RangeEncoder coder_;
  BitplaneParts parts_;
  double* count_ = &parts_.base;
};

class DecodingSide {
 public:
  DecodingSide(const std::uint8_t* begin, const std::uint8_t* end) : coder_(begin, end) {}
  bool decide(bool, Probability set) { return coder_.decode(set); }
  void count_as(double BitplaneParts::Component::*, int) {}
  void count_as_base() {}

 private:
  RangeDecoder coder_;
};

/// Octave of a magnitude in quarters of the plane's threshold: 0, 1, 2-3, 4-7, ...
int octave(std::uint64_t quarters, int classes) { return std::min<int>(std::bit_width(quarters), classes - 1); }

/// Half octaves: 0, 1, 2, 3, 4-5, 6-7, 8-11, ...
int half_octave(std::uint64_t quarters, int classes) {
  const int width = std::bit_width(quarters);
  return std::min(width < 2 ? width : 2 * width - 2 + static_cast<int>(quarters >> (width - 2) & 1), classes - 1);
}

/// Index of a tuple of values into a table of the given extents, and the size of that table.
template <class... Rest>
constexpr int tuple_index(int value, int extent, Rest... rest) {
  if constexpr (sizeof...(rest) == 0)
    return value;
  else
    return value + extent * tuple_index(rest...);
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
      near_[c].assign(nodes, 0);
      descendants_[c].assign(nodes, 0);
      children_[c].assign(nodes, 0);
      descendants_low_plane_[c].assign(nodes, layout.detail_planes);
    }
    if (actual) find_largest_descendants();
  }

  void run() {
    const int top = kPassesPerPlane * std::max(layout_.base_planes, layout_.detail_planes) - 1 + kMaxUrgency;
    for (int pass = top; pass >= kMaxUrgency; --pass) {
      if (pass % kPassesPerPlane == kPassesPerPlane - 1) urgency_ = layout_.urgency(known_);
      const int base_plane = (pass + kBaseDelay + kPassesPerPlane - 1) / kPassesPerPlane;
      if ((pass + kBaseDelay) % kPassesPerPlane == 0 && base_plane < layout_.base_planes) base_pass(base_plane);
      for (int level = 0; level < forest_.levels(); ++level)
        for (int c = 0; c < 3; ++c) detail_pass(pass, level, c);
      if (forest_.levels() < layout_.levels && reaches_below()) throw StreamEnd{};
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

  double base_midpoint(int v, int k) const {
    return known_.base[v][k] + 0.5 * static_cast<double>(1u << known_.base_low_plane[v][k]);
  }

  /// The next bit of every base coordinate. Its context is where the neighbours' mean, as far as known, lies in the
  /// interval that the bit halves: prediction from all sides, without the noise of a transform.
  void base_pass(int plane) {
    const double unit = static_cast<double>(1u << plane);
    side_.count_as_base();
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
        const int fine_place = static_cast<int>(std::clamp(std::floor(x * 12.0), -16.0, 15.0)) + 16;
        const int width = octave(static_cast<std::uint64_t>(4.0 * spread / unit), 8);
        const bool actual = actual_ && (actual_->base[v][k] >> plane & 1);
        const bool bit =
            base_model_.decide(side_, actual, {place, place * 8 + width, fine_place, place / 2 * 32 + plane}, 0);
        known_.base[v][k] |= static_cast<std::uint32_t>(bit) << plane;
        known_.base_low_plane[v][k] = plane;
      }
    }
  }

  /// Passes by which a node's bits wait, so that all bits of a pass save about as much error per bit spent: halving an
  /// interval costs a whole bit, and where nothing is significant yet, news are rare.
  int delay(int c, int n) const {
    if (known_.details[c].magnitude[n] != 0) return kRefinementDelay;
    const int parent = forest_.parent[n];
    const bool quiet = !near_[c][n] && (parent < 0 || known_.details[c].magnitude[parent] == 0);
    return quiet ? kQuietDelay : 0;
  }

  void detail_pass(int pass, int level, int c) {
    auto& known = known_.details[c];
    for (int n = forest_.level_begin[level]; n < forest_.level_begin[level + 1]; ++n) {
      const int last = std::max(0, pass - urgency_[c][n] + delay(c, n) + kPassesPerPlane - 1) / kPassesPerPlane;
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

  /// Whether descendants of `n` may be significant at `plane`. Beside anything significant they are coded one by one,
  /// for their contexts say more than a tree could; elsewhere the stream says once for the whole tree that there are
  /// none.
  bool has_descendants(int plane, int level, int c, int n) {
    std::uint8_t& open = descendants_[c][n];
    if (!open) open = known_.details[c].magnitude[n] != 0 || near_[c][n];
    std::uint8_t& low_plane = descendants_low_plane_[c][n];
    while (!open && low_plane > plane) {
      const int parent = forest_.parent[n];
      if (parent < 0 || has_descendants(low_plane - 1, level - 1, c, parent))
        open = find_descendants(low_plane - 1, level, c, n);
      --low_plane;
    }
    return open;
  }

  /// Whether the stream may say something of the first level that the forest does not have: it does where there is
  /// something at the last, or where trees of the level above that one are open. (Nodes below the forest have their
  /// parents' urgency, so they never ask for more planes of a closed tree than their parents did.)
  bool reaches_below() const {
    const int last = forest_.levels() - 1;
    if (last < 1) return true;
    for (int c = 0; c < 3; ++c) {
      for (int n = forest_.level_begin[last]; n < forest_.level_begin[last + 1]; ++n)
        if (known_.details[c].magnitude[n] != 0) return true;
      for (int n = forest_.level_begin[last - 1]; n < forest_.level_begin[last]; ++n)
        if (descendants_[c][n]) return true;
    }
    return false;
  }

  static std::uint64_t quarters(std::uint64_t magnitude, int plane) { return (magnitude << 2) >> plane; }

  /// Sum of the magnitudes of the edges beside `n`, in quarters of the threshold.
  std::uint64_t ring(int plane, int c, int n) const {
    std::uint64_t sum = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) sum += known_.details[c].magnitude[w];
    return quarters(sum, plane);
  }

  std::uint64_t parent_magnitude(int plane, int c, int n) const {
    const int parent = forest_.parent[n];
    return parent < 0 ? 0 : quarters(known_.details[c].magnitude[parent], plane);
  }

  void grow(int plane, int c, int n) {
    known_.details[c].magnitude[n] |= 1u << plane;
    if (forest_.parent[n] >= 0) children_[c][forest_.parent[n]] += std::uint64_t{1} << plane;
  }

  void find_significant(int plane, int level, int c, int n) {
    const int tangential = c != 0;
    const std::uint64_t around = ring(plane, c, n), above = parent_magnitude(plane, c, n);
    std::uint64_t wide = 2 * around + above;
    for (int w : forest_.neighbours[n])
      if (w >= 0) wide += ring(plane, c, w);
    std::uint64_t others_here = 0, others_around = 0;
    for (int o = 0; o < 3; ++o) {
      if (o == c) continue;
      others_here += quarters(known_.details[o].magnitude[n], plane);
      others_around += ring(plane, o, n);
    }
    const std::uint64_t children = quarters(children_[c][n], plane);
    const int a = octave(around, 8), p = octave(above, 7), w = octave(wide, 10), here = octave(others_here, 6);
    const int below = octave(children, 8), cross = octave(2 * others_here + others_around, 10);
    const int fine = half_octave(2 * wide + 2 * around + 4 * children + others_here + others_around / 2, 24);
    const int open = descendants_[c][n];
    side_.count_as(&BitplaneParts::Component::significance, c);
    const bool bit = significance_model_.decide(
        side_, actual_ && (actual_->details[c].magnitude[n] >> plane & 1),
        {tuple_index(tangential, 2, open, 2, p > 0, 2, w, 10, a, 8), tuple_index(c, 3, plane, 32, level, kLevels),
         tuple_index(c, 3, open, 2, here, 6, a, 8), tuple_index(tangential, 2, fine, 24, level, kLevels),
         tuple_index(tangential, 2, p, 7, a, 8, below, 8), tuple_index(c, 3, w, 10, cross, 10)},
        tangential);
    if (!bit) return;
    for (int beside : forest_.neighbours[n])
      if (beside >= 0) near_[c][beside] = 1;
    side_.count_as(&BitplaneParts::Component::signs, c);
    known_.details[c].negative[n] = side_.decide(actual_ && actual_->details[c].negative[n], 32768);
    grow(plane, c, n);
  }

  void refine(int plane, int level, int c, int n) {
    const int size = octave(known_.details[c].magnitude[n] >> (plane + 1), 5);
    const int a = octave(ring(plane, c, n), 8), p = octave(parent_magnitude(plane, c, n), 8);
    side_.count_as(&BitplaneParts::Component::refinement, c);
    const bool bit = refinement_model_.decide(side_, actual_ && (actual_->details[c].magnitude[n] >> plane & 1),
                                              {tuple_index(size, 5, a, 8), tuple_index(size, 5, c, 3),
                                               tuple_index(size, 5, level, kLevels), tuple_index(size, 5, p, 8)},
                                              0);
    if (bit) grow(plane, c, n);
  }

  bool find_descendants(int plane, int level, int c, int n) {
    const int tangential = c != 0, p = octave(parent_magnitude(plane, c, n), 6);
    int open_neighbours = 0, open_components = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) open_neighbours += descendants_[c][w];
    std::uint64_t others = 0;
    for (int o = 0; o < 3; ++o) {
      if (o == c) continue;
      open_components += descendants_[o][n];
      others += quarters(known_.details[o].magnitude[n], plane) + ring(plane, o, n);
    }
    side_.count_as(&BitplaneParts::Component::trees, c);
    return descendants_model_.decide(
        side_, actual_ && largest_[c][n] >> plane != 0,
        {tuple_index(c, 3, open_neighbours, 5, open_components, 3), tuple_index(c, 3, plane, 32, level, kLevels),
         tuple_index(tangential, 2, p, 6, level, kLevels), tuple_index(tangential, 2, octave(others, 8), 8)},
        tangential);
  }

  const EdgeForest& forest_;
  const BitplaneLayout& layout_;
  const BitplaneCoefficients* actual_;
  Side& side_;
  BitplaneCoefficients known_;
  std::array<std::vector<std::uint8_t>, 3> near_;         ///< 1 once an edge beside it is significant
  std::array<std::vector<std::uint8_t>, 3> descendants_;  ///< 1 once descendants are coded one by one
  std::array<std::vector<std::uint8_t>, 3>
      descendants_low_plane_;                           ///< above and at it, a closed tree is known to be empty
  std::array<std::vector<std::uint64_t>, 3> children_;  ///< sum of the children's known magnitudes
  std::array<std::vector<std::uint32_t>, 3> largest_;   ///< encoder only: largest magnitude of all descendants
  std::array<std::vector<std::int8_t>, 3> urgency_;

  static constexpr int kBaseDelay = 2, kRefinementDelay = 3, kQuietDelay = 2;
  static constexpr int kLevels = kMaxSubdivisionLevel + 1;
  MixedModel<4> base_model_{{16, 16 * 8, 32, 8 * 32}, 1};
  MixedModel<6> significance_model_{
      {2 * 2 * 2 * 10 * 8, 3 * 32 * kLevels, 3 * 2 * 6 * 8, 2 * 24 * kLevels, 2 * 7 * 8 * 8, 3 * 10 * 10}, 2};
  MixedModel<4> refinement_model_{{5 * 8, 5 * 3, 5 * kLevels, 5 * 8}, 1};
  MixedModel<4> descendants_model_{{3 * 5 * 3, 3 * 32 * kLevels, 2 * 6 * kLevels, 2 * 8}, 2};
};

}  // namespace

BitplaneParts encode_bitplanes(const EdgeForest& forest, const BitplaneLayout& layout,
                               const BitplaneCoefficients& coefficients, Bytes& out) {
  EncodingSide side(out);
  BitplaneCoder<EncodingSide> coder(forest, layout, &coefficients, side);
  coder.run();
  side.finish();
  return side.parts();
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
