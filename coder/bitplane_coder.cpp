#include "coder/bitplane_coder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "coder/bit_model.h"
#include "coder/coding_sides.h"
#include "coder/context_values.h"
#include "coder/due_list.h"
#include "coder/largest_descendants.h"
#include "coder/payload_check.h"

namespace gsp {

namespace {

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
    strength_.assign(nodes, 0);
    near_.assign(nodes, 0);
    open_.assign(nodes, 0);
    for (int c = 0; c < 3; ++c) {
      BitplaneCoefficients::Component& known = known_.details[c];
      known.magnitude.assign(nodes, 0);
      known.negative.assign(nodes, 0);
      known.low_plane.assign(nodes, planes);
      ring_[c].assign(nodes + 1, 0);
      children_[c].assign(nodes, 0);
      tree_low_plane_[c].assign(nodes, planes);
      urgency_[c].assign(nodes, 0);
      lanes_[c] = {known.magnitude.data(), known.negative.data(),     known.low_plane.data(), ring_[c].data() + 1,
                   children_[c].data(),    tree_low_plane_[c].data(), urgency_[c].data()};
      bit_due_.emplace_back(nodes);
      tree_due_.emplace_back(nodes);
    }
    if (layout.scalar) silence_tangential();
    if (actual) largest_ = largest_descendants(forest, *actual);
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
          const Scene at = scene(level, c);
          bit_due_[c].for_each_due(begin, end, now, [&, at](int n) { return code_bits(now, at, n); });
          if (level + 1 < layout_.levels)
            tree_due_[c].for_each_due(begin, end, now, [&, at](int n) { return code_trees(now, at, n); });
        }
        side_.count_as_check();
        check_.check_if_due(side_);
      }
    }
  }

  BitplaneCoefficients take() { return std::move(known_); }

 private:
  using Due = DueList::Pass;
  static constexpr Due kNever = DueList::kNever;
  static_assert(kMaxUrgency > kNever && kPassesPerPlane * 31 + kMaxUrgency < 256);

  /// Where the coder is, and all that decisions there are made of: copied, so that it can stay in registers, where a
  /// store of a byte cannot be taken to change it.
  struct Scene {
    int level, c;
    Lane lane, other, third;
    const int* parent;
    const std::array<int, 4>*neighbours, *children;
    std::uint32_t* strength;
    std::uint8_t *near, *open;
    DueList *bit_due, *tree_due;

    bool is_near(int n) const { return near[n] >> c & 1; }
    bool is_open(int n) const { return open[n] >> c & 1; }
    /// Whether bits of a node are coded: all of the tree above it is open.
    bool is_active(int n) const { return parent[n] < 0 || is_open(parent[n]); }
    std::uint32_t parent_magnitude(int n) const { return parent[n] < 0 ? 0 : lane.magnitude[parent[n]]; }
  };

  Scene scene(int level, int c) {
    const int other = c == 0 ? 1 : 0, third = 3 - c - other;
    return {level,
            c,
            lanes_[c],
            lanes_[other],
            lanes_[third],
            forest_.parent.data(),
            forest_.neighbours.data(),
            forest_.children.data(),
            strength_.data(),
            near_.data(),
            open_.data(),
            &bit_due_[c],
            &tree_due_[c]};
  }

  /// Nodes without a component are known down to the last plane, as all that is below them is.
  bool is_silent(int n, int c) const { return layout_.scalar && c != 0 && !forest_.on_curve(n); }

  void silence_tangential() {
    for (int n = 0; n < forest_.nodes(); ++n) {
      if (forest_.on_curve(n)) continue;
      for (int c = 1; c < 3; ++c) known_.details[c].low_plane[n] = tree_low_plane_[c][n] = 0;
    }
  }

  static int bit_of(int flags, int c) { return flags >> c & 1; }

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
        check_.note(bit);
        known_.base_low_plane[v][k] = plane;
      }
    }
  }

  void renew_urgency() {
    node_urgency_ = layout_.urgency(known_);
    const bool first = urgency_is_new_.empty();
    urgency_is_new_.assign(forest_.nodes(), false);
    const std::array<Scene, 3> at = {scene(0, 0), scene(0, 1), scene(0, 2)};
    for (int n = 0; n < forest_.nodes(); ++n) {
      if (forest_.parent[n] >= 0 && open_[forest_.parent[n]] == 0) continue;
      const std::array<std::int8_t, 3> old = {urgency_[0][n], urgency_[1][n], urgency_[2][n]};
      find_urgency(n);
      for (int c = 0; c < 3; ++c)
        if ((first || urgency_[c][n] != old[c]) && at[c].is_active(n)) schedule(at[c], n);
    }
  }

  /// Only of nodes whose bits are coded: until late in the stream these are few.
  void find_urgency(int n) {
    const std::array<std::int8_t, 3> urgency = node_urgency_(n);
    for (int c = 0; c < 3; ++c) urgency_[c][n] = urgency[c];
    urgency_is_new_[n] = true;
  }

  static Due due(const Scene& at, int n, int planes, int delay) {
    if (planes == 0) return kNever;
    return static_cast<Due>(std::max<int>(kNever, kPassesPerPlane * (planes - 1) + at.lane.urgency[n] - delay));
  }

  static Due bit_due(const Scene& at, int n) { return due(at, n, at.lane.low_plane[n], delay(at, n)); }

  static Due tree_due(const Scene& at, int n) {
    return at.is_open(n) ? kNever : due(at, n, at.lane.tree_low_plane[n], kTreeDelay);
  }

  static void schedule(const Scene& at, int n) {
    at.bit_due->set(n, bit_due(at, n));
    at.tree_due->set(n, tree_due(at, n));
  }

  /// Passes by which a node's bits wait, so that all bits of a pass save about as much error per bit spent: halving an
  /// interval costs a whole bit, and where nothing is significant yet, news are rare.
  static int delay(const Scene& at, int n) {
    if (at.lane.magnitude[n] != 0) return kRefinementDelay;
    return !at.is_near(n) && at.parent_magnitude(n) == 0 ? kQuietDelay : 0;
  }

  /// Codes the bits of a node that are due, and returns when the next one is.
  Due code_bits(Due pass, const Scene& at, int n) {
    Due due = (*at.bit_due)[n];
    while (due >= pass) {
      const int plane = at.lane.low_plane[n] - 1;
      at.lane.low_plane[n] = static_cast<std::uint8_t>(plane);
      if (at.lane.magnitude[n] != 0) {
        refine(plane, at, n);
      } else if (find_significant(plane, at, n)) {
        tell_of_significance(at, n);
        due = bit_due(at, n);
        continue;
      }
      due = plane == 0 ? kNever : static_cast<Due>(std::max<int>(kNever, due - kPassesPerPlane));
    }
    return due;
  }

  Due code_trees(Due pass, const Scene& at, int n) {
    Due due = (*at.tree_due)[n];
    while (due >= pass) {
      const int plane = at.lane.tree_low_plane[n] - 1;
      if (find_descendants(plane, at, n)) {
        open(at, n);
        return kNever;
      }
      at.lane.tree_low_plane[n] = static_cast<std::uint8_t>(plane);
      due = tree_due(at, n);
    }
    return due;
  }

  /// Beside anything significant, descendants are coded one by one, for their contexts say more than a tree could;
  /// elsewhere the stream says once for the whole tree that there are none.
  void tell_of_significance(const Scene& at, int n) {
    const bool was_open = at.is_open(n);
    open(at, n);
    for (int w : at.neighbours[n]) {
      if (w < 0 || at.is_near(w)) continue;
      at.near[w] |= 1 << at.c;
      if (!at.is_active(w)) continue;
      at.bit_due->set(w, bit_due(at, w));
      open(at, w);
    }
    if (!was_open) return;
    for (int child : at.children[n])
      if (child >= 0 && !at.is_near(child)) at.bit_due->set(child, bit_due(at, child));
  }

  void open(Scene at, int n) {
    if (at.level + 1 >= layout_.levels || at.is_open(n) || is_silent(n, at.c)) return;
    // What follows would speak of a level below the forest.
    if (at.level + 1 == forest_.levels()) throw StreamEnd{};
    at.open[n] |= 1 << at.c;
    at.tree_due->set(n, kNever);
    const std::uint8_t empty_from = at.lane.tree_low_plane[n];
    ++at.level;
    for (int child : at.children[n]) {
      if (child < 0 || is_silent(child, at.c)) continue;
      if (!urgency_is_new_[child]) find_urgency(child);
      at.lane.low_plane[child] = at.lane.tree_low_plane[child] = empty_from;
      if (at.is_near(child)) open(at, child);
      schedule(at, child);
    }
  }

  void set_bit(int plane, const Scene& at, int n) {
    check_.note(static_cast<std::uint32_t>(n) << 8 | static_cast<std::uint32_t>(plane) << 3 | at.c << 1 |
                at.lane.negative[n]);
    const std::uint32_t bit = 1u << plane;
    at.lane.magnitude[n] |= bit;
    at.strength[n] += 2 * bit;
    for (int w : at.neighbours[n]) {
      if (w < 0) continue;
      at.lane.ring[w] += bit;
      at.strength[w] += bit;
    }
    if (at.parent[n] >= 0) at.lane.children[at.parent[n]] += bit;
  }

  /// Of a node's component, what it is like: 0 along the normal, 1, 2 along the surface; of a crease 3 across the
  /// curve, where both sides bend away, and 4 along it.
  int kind(int n, int c) const { return !forest_.creased[n] ? c : c == 1 ? 4 : 3; }
  /// The same with 1 for both components along the surface.
  static int merged(int kind) { return kind == 0 ? 0 : std::max(kind - 1, 1); }

  bool find_significant(int plane, const Scene& at, int n) {
    const int c = at.c, what = kind(n, c), set = merged(what);
    std::uint64_t rings = 0;
    for (int w : at.neighbours[n]) rings += at.lane.ring[w];
    const std::uint64_t around = at.lane.ring[n];
    const std::uint64_t wide = 2 * around + at.parent_magnitude(n) + rings;
    // Nothing of this component is significant here yet.
    const std::uint64_t others = at.strength[n] - at.lane.ring[n];
    const std::uint64_t all = 2 * wide + 2 * around + 4 * std::uint64_t{at.lane.children[n]} + others / 2;
    const int w = octave(wide, plane, 10), cross = octave(others, plane, 10);
    const int fine = half_octave(all, plane, 24);
    side_.count_as(&BitplaneParts::Component::significance, c);
    const bool bit = significance_model_.decide(
        side_, actual_ && (actual_->details[c].magnitude[n] >> plane & 1),
        {tuple_index(what, kKinds, plane, 32, at.level, kLevels), tuple_index(set, kSets, fine, 24, at.level, kLevels),
         tuple_index(what, kKinds, w, 10, cross, 10)},
        set);
    side_.note_significance(c, n);
    if (!bit) return false;
    side_.count_as(&BitplaneParts::Component::signs, c);
    at.lane.negative[n] = side_.decide(actual_ && actual_->details[c].negative[n], 32768);
    set_bit(plane, at, n);
    return true;
  }

  void refine(int plane, const Scene& at, int n) {
    const int size = octave(at.lane.magnitude[n], plane + 3, 5);
    const int a = octave(at.lane.ring[n], plane, 8), p = octave(at.parent_magnitude(n), plane, 8);
    side_.count_as(&BitplaneParts::Component::refinement, at.c);
    const bool bit = refinement_model_.decide(side_, actual_ && (actual_->details[at.c].magnitude[n] >> plane & 1),
                                              {tuple_index(size, 5, a, 8), tuple_index(size, 5, p, 8)}, 0);
    if (bit) set_bit(plane, at, n);
  }

  bool find_descendants(int plane, const Scene& at, int n) {
    const int c = at.c, set = merged(kind(n, c)), o = c == 0 ? 1 : 0, q = 3 - c - o;
    const int p = octave(at.parent_magnitude(n), plane, 6);
    int open_neighbours = 0;
    for (int w : at.neighbours[n])
      if (w >= 0) open_neighbours += at.is_open(w);
    const int open_components = bit_of(at.open[n], o) + bit_of(at.open[n], q);
    const std::uint64_t others =
        std::uint64_t{at.other.magnitude[n]} + at.third.magnitude[n] + at.other.ring[n] + at.third.ring[n];
    side_.count_as(&BitplaneParts::Component::trees, c);
    return descendants_model_.decide(
        side_, actual_ && largest_[n][c] >> plane != 0,
        {tuple_index(set, kSets, open_neighbours, 5, open_components, 3, octave(others, plane, 4), 4),
         tuple_index(set, kSets, p, 6, at.level, kLevels)},
        set);
  }

  const EdgeForest& forest_;
  const BitplaneLayout& layout_;
  const BitplaneCoefficients* actual_;
  Side& side_;
  BitplaneCoefficients known_;
  // What contexts are made of: kept up to date when a bit is set, since it is asked for many times as often.
  std::array<std::vector<std::uint32_t>, 3> ring_, children_;
  std::array<std::vector<std::uint8_t>, 3> tree_low_plane_;
  std::array<Lane, 3> lanes_;
  std::vector<std::uint32_t> strength_;  ///< of all components: twice the magnitude and those beside it
  std::vector<std::uint8_t> near_;       ///< bit c: an edge beside it is significant
  std::vector<std::uint8_t> open_;       ///< bit c: its descendants are coded one by one
  std::vector<DueList> bit_due_, tree_due_;
  std::vector<std::array<std::uint32_t, 3>> largest_;  ///< encoder only: largest_descendants.h
  PayloadCheck check_;
  NodeUrgency node_urgency_;  ///< since the last renewal
  std::array<std::vector<std::int8_t>, 3> urgency_;
  std::vector<std::uint8_t> urgency_is_new_;  ///< not that of before the last renewal

  static constexpr int kBaseDelay = 2, kRefinementDelay = 3, kQuietDelay = 2, kTreeDelay = 2;
  // Urgency is renewed while the surface still takes shape: later it hardly changes, and costs most.
  static constexpr int kPlanesPerUrgency = 2, kLastUrgency = kMaxUrgency + 8 * kPassesPerPlane;
  static constexpr int kLevels = kMaxSubdivisionLevel + 1;
  MixedModel<1, 16, 16 * 8, 32, 8 * 32> base_model_;
  static constexpr int kKinds = 5, kSets = 4;
  MixedModel<kSets, kKinds * 32 * kLevels, kSets * 24 * kLevels, kKinds * 10 * 10> significance_model_;
  MixedModel<1, 5 * 8, 5 * 8> refinement_model_;
  MixedModel<kSets, kSets * 5 * 3 * 4, kSets * 6 * kLevels> descendants_model_;
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
