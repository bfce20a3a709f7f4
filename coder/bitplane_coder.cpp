#include "coder/bitplane_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "coder/bit_model.h"
#include "coder/coding_sides.h"
#include "coder/due_list.h"

namespace gsp {

namespace {

/// Octave of a magnitude < 2^62 in quarters of the plane's threshold: 0, 1, 2-3, 4-7, ...
int octave(std::uint64_t magnitude, int plane, int classes) {
  return std::clamp(static_cast<int>(std::bit_width(4 * magnitude)) - plane, 0, classes - 1);
}

/// Half octaves: 0, 1, 2, 3, 4-5, 6-7, 8-11, ...
int half_octave(std::uint64_t magnitude, int plane, int classes) {
  const int bits = static_cast<int>(std::bit_width(4 * magnitude)), width = bits - plane;
  if (width < 2) return std::max(width, 0);
  const int second = static_cast<int>(4 * magnitude >> (bits - 2) & 1);
  return std::min(2 * width - 2 + second, classes - 1);
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
    const std::uint8_t planes = static_cast<std::uint8_t>(layout.detail_planes);
    known_.base.assign(vertices, {0, 0, 0});
    known_.base_low_plane.assign(vertices, {});
    for (auto& low : known_.base_low_plane) low.fill(layout.base_planes);
    near_.assign(nodes, 0);
    open_.assign(nodes, 0);
    for (int c = 0; c < 3; ++c) {
      known_.details[c].magnitude.assign(nodes, 0);
      known_.details[c].negative.assign(nodes, 0);
      known_.details[c].low_plane.assign(nodes, planes);
      ring_[c].assign(nodes + 1, 0);
      children_[c].assign(nodes, 0);
      tree_low_plane_[c].assign(nodes, planes);
      bit_due_.emplace_back(nodes);
      tree_due_.emplace_back(nodes);
    }
    if (actual) find_largest_descendants();
  }

  void run() {
    const int top = kPassesPerPlane * std::max(layout_.base_planes, layout_.detail_planes) - 1 + kMaxUrgency;
    for (int pass = top; pass >= layout_.last_pass; --pass) {
      if (pass == top || (pass >= kLastUrgency && pass % (kPlanesPerUrgency * kPassesPerPlane) == 0)) renew_urgency();
      const int base_plane = (pass + kBaseDelay + kPassesPerPlane - 1) / kPassesPerPlane;
      if ((pass + kBaseDelay) % kPassesPerPlane == 0 && base_plane < layout_.base_planes) base_pass(base_plane);
      const Due now = static_cast<Due>(pass);
      for (int level = 0; level < forest_.levels(); ++level) {
        const int begin = forest_.level_begin[level], end = forest_.level_begin[level + 1];
        for (int c = 0; c < 3; ++c) {
          bit_due_[c].for_each_due(begin, end, now, [&](int n) { code_bits(now, level, c, n); });
          if (level + 1 < layout_.levels)
            tree_due_[c].for_each_due(begin, end, now, [&](int n) { code_trees(now, level, c, n); });
        }
      }
    }
  }

  BitplaneCoefficients take() { return std::move(known_); }

 private:
  using Due = DueList::Pass;
  static constexpr Due kNever = DueList::kNever;
  static_assert(kMaxUrgency > kNever && kPassesPerPlane * 31 + kMaxUrgency < 256);

  static int bit_of(int flags, int c) { return flags >> c & 1; }

  void find_largest_descendants() {
    largest_.assign(forest_.nodes(), {0, 0, 0});
    for (int n = forest_.nodes() - 1; n >= 0; --n) {
      const int parent = forest_.parent[n];
      if (parent < 0) continue;
      for (int c = 0; c < 3; ++c)
        largest_[parent][c] = std::max({largest_[parent][c], largest_[n][c], actual_->details[c].magnitude[n]});
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
        const int width = octave(static_cast<std::uint64_t>(4.0 * spread / unit), 2, 8);
        const bool actual = actual_ && (actual_->base[v][k] >> plane & 1);
        const bool bit =
            base_model_.decide(side_, actual, {place, place * 8 + width, fine_place, place / 2 * 32 + plane}, 0);
        known_.base[v][k] |= static_cast<std::uint32_t>(bit) << plane;
        known_.base_low_plane[v][k] = plane;
      }
    }
  }

  void renew_urgency() {
    const std::array<std::vector<std::int8_t>, 3> old = std::exchange(urgency_, layout_.urgency(known_));
    for (int c = 0; c < 3; ++c)
      for (int n = 0; n < forest_.nodes(); ++n)
        if ((old[c].empty() || old[c][n] != urgency_[c][n]) && active(c, n)) schedule(c, n);
  }

  /// Whether bits of a node are coded: all of the tree above it is open.
  bool active(int c, int n) const {
    const int parent = forest_.parent[n];
    return parent < 0 || bit_of(open_[parent], c);
  }

  Due due(int c, int n, int planes, int delay) const {
    if (planes == 0) return kNever;
    return static_cast<Due>(std::max<int>(kNever, kPassesPerPlane * (planes - 1) + urgency_[c][n] - delay));
  }

  void schedule_bit(int c, int n) { bit_due_[c].set(n, due(c, n, known_.details[c].low_plane[n], delay(c, n))); }

  void schedule_tree(int c, int n) {
    tree_due_[c].set(n, bit_of(open_[n], c) ? kNever : due(c, n, tree_low_plane_[c][n], kTreeDelay));
  }

  void schedule(int c, int n) {
    schedule_bit(c, n);
    schedule_tree(c, n);
  }

  /// Passes by which a node's bits wait, so that all bits of a pass save about as much error per bit spent: halving an
  /// interval costs a whole bit, and where nothing is significant yet, news are rare.
  int delay(int c, int n) const {
    if (known_.details[c].magnitude[n] != 0) return kRefinementDelay;
    const int parent = forest_.parent[n];
    const bool quiet = !bit_of(near_[n], c) && (parent < 0 || known_.details[c].magnitude[parent] == 0);
    return quiet ? kQuietDelay : 0;
  }

  void code_bits(Due pass, int level, int c, int n) {
    auto& known = known_.details[c];
    Due due = bit_due_[c][n];
    while (due >= pass) {
      const int plane = known.low_plane[n] - 1;
      known.low_plane[n] = static_cast<std::uint8_t>(plane);
      if (known.magnitude[n] != 0) {
        refine(plane, c, n);
      } else if (find_significant(plane, level, c, n)) {
        schedule_bit(c, n);
        tell_of_significance(level, c, n);
        due = bit_due_[c][n];
        continue;
      }
      due = plane == 0 ? kNever : static_cast<Due>(std::max<int>(kNever, due - kPassesPerPlane));
    }
    bit_due_[c].set(n, due);
  }

  void code_trees(Due pass, int level, int c, int n) {
    while (tree_due_[c][n] >= pass) {
      const int plane = tree_low_plane_[c][n] - 1;
      if (find_descendants(plane, level, c, n)) return open(level, c, n);
      tree_low_plane_[c][n] = static_cast<std::uint8_t>(plane);
      schedule_tree(c, n);
    }
  }

  /// Beside anything significant, descendants are coded one by one, for their contexts say more than a tree could;
  /// elsewhere the stream says once for the whole tree that there are none.
  void tell_of_significance(int level, int c, int n) {
    open(level, c, n);
    for (int w : forest_.neighbours[n]) {
      if (w < 0) continue;
      near_[w] |= 1 << c;
      if (!active(c, w)) continue;
      schedule_bit(c, w);
      open(level, c, w);
    }
    for (int child : forest_.children[n])
      if (child >= 0) schedule_bit(c, child);
  }

  void open(int level, int c, int n) {
    if (level + 1 >= layout_.levels || bit_of(open_[n], c)) return;
    // What follows would speak of a level below the forest.
    if (level + 1 == forest_.levels()) throw StreamEnd{};
    open_[n] |= 1 << c;
    tree_due_[c].set(n, kNever);
    const std::uint8_t empty_from = tree_low_plane_[c][n];
    for (int child : forest_.children[n]) {
      if (child < 0) continue;
      known_.details[c].low_plane[child] = tree_low_plane_[c][child] = empty_from;
      if (bit_of(near_[child], c)) open(level + 1, c, child);
      schedule(c, child);
    }
  }

  std::uint32_t ring(int c, int n) const { return ring_[c][n + 1]; }

  std::uint32_t parent_magnitude(int c, int n) const {
    const int parent = forest_.parent[n];
    return parent < 0 ? 0 : known_.details[c].magnitude[parent];
  }

  void set_bit(int plane, int c, int n) {
    const std::uint32_t bit = 1u << plane;
    known_.details[c].magnitude[n] |= bit;
    for (int w : forest_.neighbours[n])
      if (w >= 0) ring_[c][w + 1] += bit;
    if (forest_.parent[n] >= 0) children_[c][forest_.parent[n]] += bit;
  }

  bool find_significant(int plane, int level, int c, int n) {
    const int tangential = c != 0, o = c == 0 ? 1 : 0, q = 3 - c - o;
    std::uint64_t rings = 0;
    for (int w : forest_.neighbours[n]) rings += ring_[c][w + 1];
    const std::uint64_t around = ring(c, n);
    const std::uint64_t wide = 2 * around + parent_magnitude(c, n) + rings;
    const std::uint64_t others_here = std::uint64_t{known_.details[o].magnitude[n]} + known_.details[q].magnitude[n];
    const std::uint64_t others_around = std::uint64_t{ring(o, n)} + ring(q, n);
    const std::uint64_t all =
        2 * wide + 2 * around + 4 * std::uint64_t{children_[c][n]} + others_here + others_around / 2;
    const int w = octave(wide, plane, 10), cross = octave(2 * others_here + others_around, plane, 10);
    const int fine = half_octave(all, plane, 24);
    side_.count_as(&BitplaneParts::Component::significance, c);
    const bool bit = significance_model_.decide(
        side_, actual_ && (actual_->details[c].magnitude[n] >> plane & 1),
        {tuple_index(c, 3, plane, 32, level, kLevels), tuple_index(tangential, 2, fine, 24, level, kLevels),
         tuple_index(c, 3, w, 10, cross, 10)},
        tangential);
    side_.note_significance(c, n);
    if (!bit) return false;
    side_.count_as(&BitplaneParts::Component::signs, c);
    known_.details[c].negative[n] = side_.decide(actual_ && actual_->details[c].negative[n], 32768);
    set_bit(plane, c, n);
    return true;
  }

  void refine(int plane, int c, int n) {
    const int size = octave(known_.details[c].magnitude[n], plane + 3, 5);
    const int a = octave(ring(c, n), plane, 8), p = octave(parent_magnitude(c, n), plane, 8);
    side_.count_as(&BitplaneParts::Component::refinement, c);
    const bool bit = refinement_model_.decide(side_, actual_ && (actual_->details[c].magnitude[n] >> plane & 1),
                                              {tuple_index(size, 5, a, 8), tuple_index(size, 5, p, 8)}, 0);
    if (bit) set_bit(plane, c, n);
  }

  bool find_descendants(int plane, int level, int c, int n) {
    const int tangential = c != 0, o = c == 0 ? 1 : 0, q = 3 - c - o;
    const int p = octave(parent_magnitude(c, n), plane, 6);
    int open_neighbours = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) open_neighbours += bit_of(open_[w], c);
    const int open_components = bit_of(open_[n], o) + bit_of(open_[n], q);
    const std::uint64_t others =
        std::uint64_t{known_.details[o].magnitude[n]} + known_.details[q].magnitude[n] + ring(o, n) + ring(q, n);
    side_.count_as(&BitplaneParts::Component::trees, c);
    return descendants_model_.decide(
        side_, actual_ && largest_[n][c] >> plane != 0,
        {tuple_index(tangential, 2, open_neighbours, 5, open_components, 3, octave(others, plane, 4), 4),
         tuple_index(tangential, 2, p, 6, level, kLevels)},
        tangential);
  }

  const EdgeForest& forest_;
  const BitplaneLayout& layout_;
  const BitplaneCoefficients* actual_;
  Side& side_;
  BitplaneCoefficients known_;
  // What contexts are made of: kept up to date when a bit is set, since it is asked for many times as often.
  std::array<std::vector<std::uint32_t>, 3> ring_;           ///< 1 + #N, a 0 and sums of magnitudes beside each
  std::array<std::vector<std::uint32_t>, 3> children_;       ///< sum of the children's magnitudes
  std::vector<std::uint8_t> near_;                           ///< bit c: an edge beside it is significant
  std::vector<std::uint8_t> open_;                           ///< bit c: its descendants are coded one by one
  std::array<std::vector<std::uint8_t>, 3> tree_low_plane_;  ///< at and above it, a closed tree is known to be empty
  std::vector<DueList> bit_due_, tree_due_;
  std::vector<std::array<std::uint32_t, 3>> largest_;  ///< encoder only: largest magnitudes of all descendants
  std::array<std::vector<std::int8_t>, 3> urgency_;

  static constexpr int kBaseDelay = 2, kRefinementDelay = 3, kQuietDelay = 2, kTreeDelay = 2;
  // Urgency is renewed while the surface still takes shape: later it hardly changes, and costs most.
  static constexpr int kPlanesPerUrgency = 2, kLastUrgency = kMaxUrgency + 8 * kPassesPerPlane;
  static constexpr int kLevels = kMaxSubdivisionLevel + 1;
  MixedModel<4> base_model_{{16, 16 * 8, 32, 8 * 32}, 1};
  MixedModel<3> significance_model_{{3 * 32 * kLevels, 2 * 24 * kLevels, 3 * 10 * 10}, 2};
  MixedModel<2> refinement_model_{{5 * 8, 5 * 8}, 1};
  MixedModel<2> descendants_model_{{2 * 5 * 3 * 4, 2 * 6 * kLevels}, 2};
};

}  // namespace

BitplaneParts encode_bitplanes(const EdgeForest& forest, const BitplaneLayout& layout,
                               const BitplaneCoefficients& coefficients, Bytes& out) {
  EncodingSide side(out);
  BitplaneCoder<EncodingSide> coder(forest, layout, &coefficients, side);
  coder.run();
  if (layout.last_pass == kMaxUrgency) side.finish();
  return side.parts();
}

BitplaneState encode_bitplanes_until(const EdgeForest& forest, const BitplaneLayout& layout,
                                     const BitplaneCoefficients& coefficients, std::size_t bytes) {
  Bytes out;
  PricingSide side(out, bytes, forest.nodes());
  BitplaneCoder<PricingSide> coder(forest, layout, &coefficients, side);
  try {
    coder.run();
  } catch (const StreamEnd&) {
    // Enough is written.
  }
  return {coder.take(), std::move(side.prices)};
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
