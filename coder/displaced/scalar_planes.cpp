#include "coder/displaced/scalar_planes.h"

#include <algorithm>
#include <utility>

#include "coder/bit_model.h"
#include "coder/coding_sides.h"
#include "coder/context_values.h"

namespace gsp {

namespace {

template <class Side>
class ScalarCoder {
 public:
  ScalarCoder(const ScalarForest& forest, const ScalarLayout& layout, const ScalarIntegers* actual, Side& side)
      : forest_(forest), layout_(layout), actual_(actual), side_(side) {
    const std::size_t nodes = forest.nodes();
    known_.magnitude.assign(nodes, 0);
    known_.negative.assign(nodes, 0);
    known_.low_plane.assign(nodes, static_cast<std::uint8_t>(layout.planes));
    ring_.assign(nodes + 1, 0);
    children_.assign(nodes, 0);
    open_.assign(nodes, 0);
    near_.assign(nodes, 0);
    if (actual) {
      largest_.assign(nodes, 0);
      for (int n = forest.nodes() - 1; n >= 0; --n)
        if (const int parent = forest.parent[n]; parent >= 0)
          largest_[parent] = std::max({largest_[parent], largest_[n], actual->magnitude[n]});
    }
  }

  template <class Mark>
  void run(Mark mark) {
    for (int plane = layout_.planes - 1; plane >= layout_.last_plane; --plane) {
      for (int pass = 0; pass < 3; ++pass) {
        for (int level = 0; level < forest_.levels(); ++level) {
          level_ = level;
          for (int n = forest_.level_begin[level]; n < forest_.level_begin[level + 1]; ++n) {
            if (!active(n)) continue;
            visit(pass, plane, n);
          }
        }
        mark();
      }
    }
  }

  ScalarIntegers take() { return std::move(known_); }

 private:
  bool active(int n) const { return forest_.parent[n] < 0 || open_[forest_.parent[n]]; }
  bool last_level() const { return level_ + 1 == forest_.levels(); }

  void visit(int pass, int plane, int n) {
    if (pass == 2) {
      if (known_.magnitude[n] != 0 && known_.low_plane[n] > plane) refine(plane, n);
      return;
    }
    if (known_.magnitude[n] == 0 && known_.low_plane[n] > plane) {
      const bool quiet = !near_[n] && (forest_.parent[n] < 0 || known_.magnitude[forest_.parent[n]] == 0);
      if (pass == 1 || !quiet) {
        known_.low_plane[n] = static_cast<std::uint8_t>(plane);
        if (find_significant(plane, n)) {
          open_[n] = 1;
          for (int w : forest_.neighbours[n])
            if (w >= 0) near_[w] = 1, open_if_active(w);
        }
      }
    }
    if (pass == 1 && level_ > 0 && !last_level() && !open_[n]) {
      if (find_descendants(plane, n)) open_[n] = 1;
    }
  }

  void open_if_active(int n) { if (active(n)) open_[n] = 1; }

  void set_bit(int plane, int n) {
    const std::uint32_t bit = 1u << plane;
    known_.magnitude[n] |= bit;
    for (int w : forest_.neighbours[n])
      if (w >= 0) ring_[w] += bit;
    if (forest_.parent[n] >= 0) children_[forest_.parent[n]] += bit;
  }

  std::uint64_t magnitude(int n) const { return n < 0 ? 0 : known_.magnitude[n]; }

  bool find_significant(int plane, int n) {
    std::uint64_t rings = 0;
    for (int w : forest_.neighbours[n]) if (w >= 0) rings += ring_[w];
    const std::uint64_t around = ring_[n], up = magnitude(forest_.parent[n]);
    const std::uint64_t ends = magnitude(forest_.ends[n][0]) + magnitude(forest_.ends[n][1]);
    const std::uint64_t wide = 2 * around + up + rings;
    const std::uint64_t all = 2 * wide + 2 * around + 4 * std::uint64_t{children_[n]};
    const int fine = half_octave(all, plane, 24);
    side_.count_as(&BitplaneParts::Component::significance, 0);
    const int level = level_;
    const bool bit = significance_.decide(
        side_, actual_ && (actual_->magnitude[n] >> plane & 1),
        {tuple_index(plane, 32, level, kLevels), tuple_index(fine, 24, level, kLevels),
         tuple_index(octave(around, plane, 8), 8, octave(up, plane, 8), 8, octave(children_[n], plane, 4), 4),
         tuple_index(octave(wide, plane, 10), 10, octave(ends, plane, 8), 8),
         tuple_index(layout_.place.empty() ? 0 : layout_.place[n], 32, plane, 32)},
        std::min(level, 3));
    if (!bit) return false;
    side_.count_as(&BitplaneParts::Component::signs, 0);
    known_.negative[n] = side_.decide(actual_ && actual_->negative[n], 32768);
    set_bit(plane, n);
    return true;
  }

  void refine(int plane, int n) {
    known_.low_plane[n] = static_cast<std::uint8_t>(plane);
    const int size = octave(known_.magnitude[n], plane + 3, 5);
    const int a = octave(ring_[n], plane, 8), p = octave(magnitude(forest_.parent[n]), plane, 8);
    side_.count_as(&BitplaneParts::Component::refinement, 0);
    if (refinement_.decide(side_, actual_ && (actual_->magnitude[n] >> plane & 1),
                           {tuple_index(size, 5, a, 8), tuple_index(size, 5, p, 8)}, 0))
      set_bit(plane, n);
  }

  bool find_descendants(int plane, int n) {
    int open_neighbours = 0;
    for (int w : forest_.neighbours[n]) if (w >= 0) open_neighbours += open_[w];
    const int p = octave(magnitude(forest_.parent[n]), plane, 6), a = octave(magnitude(n) + ring_[n], plane, 6);
    side_.count_as(&BitplaneParts::Component::trees, 0);
    return descendants_.decide(
        side_, actual_ && largest_[n] >> plane != 0,
        {tuple_index(open_neighbours, 5, a, 6), tuple_index(p, 6, level_, kLevels), tuple_index(plane, 32, level_, kLevels)}, 0);
  }

  static constexpr int kLevels = kMaxSubdivisionLevel + 2;
  const ScalarForest& forest_;
  const ScalarLayout& layout_;
  const ScalarIntegers* actual_;
  Side& side_;
  ScalarIntegers known_;
  std::vector<std::uint32_t> ring_, children_;
  std::vector<std::uint8_t> open_, near_;
  std::vector<std::uint32_t> largest_;
  int level_ = 0;
  MixedModel<4, 32 * kLevels, 24 * kLevels, 8 * 8 * 4, 10 * 8, 32 * 32> significance_;
  MixedModel<1, 5 * 8, 5 * 8> refinement_;
  MixedModel<1, 5 * 6, 6 * kLevels, 32 * kLevels> descendants_;
};

}  // namespace

BitplaneParts encode_scalars(const ScalarForest& forest, const ScalarLayout& layout, const ScalarIntegers& integers,
                             Bytes& out, std::vector<std::size_t>* pass_ends) {
  EncodingSide side(out);
  ScalarCoder<EncodingSide> coder(forest, layout, &integers, side);
  coder.run([&] {
    if (pass_ends) pass_ends->push_back(out.size());
  });
  side.finish();
  return side.parts();
}

ScalarIntegers decode_scalars(const ScalarForest& forest, const ScalarLayout& layout, const std::uint8_t* begin,
                              const std::uint8_t* end) {
  DecodingSide side(begin, end);
  ScalarCoder<DecodingSide> coder(forest, layout, nullptr, side);
  try {
    coder.run([] {});
  } catch (const StreamEnd&) {
    // A prefix.
  }
  return coder.take();
}

}  // namespace gsp
