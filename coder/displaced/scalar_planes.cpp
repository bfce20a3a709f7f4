#include "coder/displaced/scalar_planes.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "coder/bit_model.h"
#include "coder/coding_sides.h"
#include "coder/context_values.h"
#include "coder/payload_check.h"

namespace gsp {

namespace {

template <class Side>
class ScalarCoder {
 public:
  /// `actual`: null to decode.
  ScalarCoder(const ScalarForest& forest, int stream_levels, int planes, const ScalarIntegers* actual, Side& side)
      : forest_(forest), stream_levels_(stream_levels), planes_(planes), actual_(actual), side_(side) {
    const std::size_t nodes = forest.nodes();
    known_.magnitude.assign(nodes, 0);
    known_.negative.assign(nodes, 0);
    known_.low_plane.assign(nodes, static_cast<std::uint8_t>(planes));
    ring_.assign(nodes, 0);
    children_.assign(nodes, 0);
    open_.assign(nodes, 0);
    near_.assign(nodes, 0);
    if (!actual) return;
    largest_.assign(nodes, 0);
    for (auto group = forest.groups.rbegin(); group != forest.groups.rend(); ++group)
      for (int n = group->begin; n < group->end; ++n)
        if (const int parent = forest.parent[n]; parent >= 0)
          largest_[parent] = std::max({largest_[parent], largest_[n], actual->magnitude[n]});
  }

  void run() {
    for (int plane = planes_ - 1; plane >= 0; --plane)
      for (Pass pass : {Pass::Beside, Pass::Quiet, Pass::Refine})
        for (const ScalarForest::Group& group : forest_.groups) {
          group_ = &group;
          for (int n = group.begin; n < group.end; ++n)
            if (is_active(n)) visit(pass, plane, n);
          side_.count_as_check();
          check_.check_if_due(side_);
        }
  }

  ScalarIntegers take() { return std::move(known_); }

 private:
  enum class Pass { Beside, Quiet, Refine };

  /// Whether bits of a node are coded: all of the tree above it is open.
  bool is_active(int n) const { return forest_.parent[n] < 0 || open_[forest_.parent[n]]; }
  bool has_descendants() const { return group_->level > 0 && group_->level + 1 < stream_levels_; }
  std::uint64_t magnitude(int n) const { return n < 0 ? 0 : known_.magnitude[n]; }

  void visit(Pass pass, int plane, int n) {
    const bool due = known_.low_plane[n] > plane;
    if (pass == Pass::Refine) {
      if (due && known_.magnitude[n] != 0) refine(plane, n);
      return;
    }
    const bool quiet = !near_[n] && magnitude(forest_.parent[n]) == 0;
    // The second pass takes all that the first has not, such as what was opened after it.
    if (due && known_.magnitude[n] == 0 && (pass == Pass::Quiet || !quiet)) {
      known_.low_plane[n] = static_cast<std::uint8_t>(plane);
      if (find_significant(plane, n)) tell_of_significance(n);
    }
    if (pass == Pass::Quiet && has_descendants() && !open_[n] && find_descendants(plane, n)) open(n);
  }

  /// Beside anything significant descendants are coded one by one, for their contexts say more than a tree could.
  void tell_of_significance(int n) {
    open(n);
    for (int w : forest_.neighbours[n]) {
      if (w < 0) continue;
      near_[w] = 1;
      if (is_active(w)) open(w);
    }
  }

  void open(int n) {
    if (!has_descendants()) return;
    // What follows would speak of a level below the forest.
    if (group_->level + 1 == forest_.levels()) throw StreamEnd{};
    open_[n] = 1;
  }

  void set_bit(int plane, int n) {
    check_.note(static_cast<std::uint32_t>(forest_.vertex[n]) << 7 | static_cast<std::uint32_t>(group_->across) << 6 |
                static_cast<std::uint32_t>(plane) << 1 | known_.negative[n]);
    const std::uint32_t bit = 1u << plane;
    known_.magnitude[n] |= bit;
    for (int w : forest_.neighbours[n])
      if (w >= 0) ring_[w] += bit;
    if (forest_.parent[n] >= 0) children_[forest_.parent[n]] += bit;
  }

  bool find_significant(int plane, int n) {
    std::uint64_t rings = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) rings += ring_[w];
    const std::uint64_t ring = ring_[n], up = magnitude(forest_.parent[n]);
    const std::uint64_t ends = magnitude(forest_.ends[n][0]) + magnitude(forest_.ends[n][1]);
    const std::uint64_t wide = 2 * ring + up + rings;
    const std::uint64_t all = 2 * wide + 2 * ring + 4 * std::uint64_t{children_[n]};
    const int level = group_->level, across = group_->across;
    side_.count_as(&BitplaneParts::Component::significance, across);
    const bool bit = significance_.decide(
        side_, actual_ && (actual_->magnitude[n] >> plane & 1),
        {tuple_index(across, 2, plane, 32, level, kLevels),
         tuple_index(half_octave(all, plane, 24), 24, level, kLevels),
         tuple_index(octave(ring, plane, 8), 8, octave(up, plane, 8), 8, octave(children_[n], plane, 4), 4),
         tuple_index(octave(wide, plane, 10), 10, octave(ends, plane, 8), 8)},
        across ? kMixers - 1 : std::min(level, kMixers - 2));
    if (!bit) return false;
    side_.count_as(&BitplaneParts::Component::signs, across);
    known_.negative[n] = find_sign(plane, n);
    set_bit(plane, n);
    return true;
  }

  std::int64_t value(int n) const {
    if (n < 0) return 0;
    const std::int64_t size = known_.magnitude[n];
    return known_.negative[n] ? -size : size;
  }
  static int sign(std::int64_t x) { return (x > 0) - (x < 0); }
  /// Octaves of a signed sum from the plane's threshold on, `half` each way: 2·half + 1 classes.
  static int signed_octave(std::int64_t x, int plane, int half) {
    return half + sign(x) * octave(static_cast<std::uint64_t>(std::abs(x)), plane + 2, half + 1);
  }

  /// Signs depend on those around, since a wavelet of neighbouring edges overlaps: that saves a fifth of their bits
  /// (bench/README.md, Displaced meshes).
  bool find_sign(int plane, int n) {
    std::int64_t ring = 0, second = 0, ends = 0, around_ends = 0;
    int pattern = 0;
    for (int w : forest_.neighbours[n]) {
      ring += value(w);
      pattern = 3 * pattern + sign(value(w)) + 1;
      if (w < 0) continue;
      for (int x : forest_.neighbours[w])
        if (x != n) second += value(x);
    }
    for (int end : forest_.ends[n]) {
      ends += value(end);
      if (end < 0) continue;
      for (int w : forest_.neighbours[end]) around_ends += value(w);
    }
    const int signs = sign(value(forest_.ends[n][0])) + sign(value(forest_.ends[n][1])) + 2;
    const int up = sign(value(forest_.parent[n])) + 1, level = std::min(group_->level, 3);
    return sign_.decide(side_, actual_ && actual_->negative[n],
                        {tuple_index(pattern, 81, level, 4), tuple_index(signs, 5, up, 3, level, 4),
                         tuple_index(signed_octave(ring, plane, 5), 11, signed_octave(ends, plane, 4), 9),
                         tuple_index(signed_octave(second, plane, 4), 9, signed_octave(ring, plane, 3), 7),
                         tuple_index(signed_octave(around_ends, plane, 4), 9, signed_octave(ends, plane, 3), 7)},
                        level);
  }

  void refine(int plane, int n) {
    known_.low_plane[n] = static_cast<std::uint8_t>(plane);
    const int size = octave(known_.magnitude[n], plane + 3, 5);
    side_.count_as(&BitplaneParts::Component::refinement, group_->across);
    if (refinement_.decide(side_, actual_ && (actual_->magnitude[n] >> plane & 1),
                           {tuple_index(size, 5, octave(ring_[n], plane, 8), 8),
                            tuple_index(size, 5, octave(magnitude(forest_.parent[n]), plane, 8), 8)},
                           0))
      set_bit(plane, n);
  }

  bool find_descendants(int plane, int n) {
    int open_neighbours = 0;
    for (int w : forest_.neighbours[n])
      if (w >= 0) open_neighbours += open_[w];
    const int up = octave(magnitude(forest_.parent[n]), plane, 6);
    const int here = octave(magnitude(n) + ring_[n], plane, 6), level = group_->level, across = group_->across;
    side_.count_as(&BitplaneParts::Component::trees, across);
    return descendants_.decide(side_, actual_ && largest_[n] >> plane != 0,
                               {tuple_index(open_neighbours, 5, here, 6), tuple_index(up, 6, level, kLevels),
                                tuple_index(across, 2, plane, 32, level, kLevels)},
                               0);
  }

  static constexpr int kLevels = kMaxSubdivisionLevel + 1;
  static constexpr int kMixers = 5;  ///< by level, the finer ones together, and one for nodes across the boundary

  const ScalarForest& forest_;
  const int stream_levels_, planes_;
  const ScalarIntegers* actual_;
  Side& side_;
  const ScalarForest::Group* group_ = nullptr;
  ScalarIntegers known_;
  std::vector<std::uint32_t> ring_, children_;  ///< sums of the magnitudes beside and below each
  std::vector<std::uint8_t> open_;              ///< its children are coded one by one
  std::vector<std::uint8_t> near_;              ///< a neighbour is significant
  std::vector<std::uint32_t> largest_;          ///< encoder only: the largest magnitude of all descendants
  PayloadCheck check_;
  MixedModel<kMixers, 2 * 32 * kLevels, 24 * kLevels, 8 * 8 * 4, 10 * 8> significance_;
  MixedModel<4, 81 * 4, 5 * 3 * 4, 11 * 9, 9 * 7, 9 * 7> sign_;
  MixedModel<1, 5 * 8, 5 * 8> refinement_;
  MixedModel<1, 5 * 6, 6 * kLevels, 2 * 32 * kLevels> descendants_;
};

}  // namespace

BitplaneParts encode_scalars(const ScalarForest& forest, int planes, const ScalarIntegers& integers, Bytes& out) {
  EncodingSide side(out);
  ScalarCoder<EncodingSide>(forest, forest.levels(), planes, &integers, side).run();
  side.finish();
  return side.parts();
}

ScalarIntegers decode_scalars(const ScalarForest& forest, int stream_levels, int planes, const std::uint8_t* begin,
                              const std::uint8_t* end) {
  DecodingSide side(begin, end);
  ScalarCoder<DecodingSide> coder(forest, stream_levels, planes, nullptr, side);
  try {
    coder.run();
  } catch (const StreamEnd&) {
    // A prefix: everything before the first undetermined decision is known.
  }
  return coder.take();
}

}  // namespace gsp
