#include <catch2/catch.hpp>
#include <cmath>

#include "coder/bitplane_coder.h"
#include "coder/coding_sides.h"
#include "coder/displaced/scalar_planes.h"
#include "coder/payload_check.h"
#include "tests/cause_of.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

constexpr int kPlanes = 10;

/// Random magnitudes, most of them small, of `nodes` nodes.
BitplaneCoefficients::Component random_component(int nodes, Random& random) {
  BitplaneCoefficients::Component component;
  for (int n = 0; n < nodes; ++n) {
    const double size = random.uniform();
    component.magnitude.push_back(static_cast<std::uint32_t>(std::ldexp(size * size * size * size, kPlanes)));
    component.negative.push_back(random.uniform() < 0.5);
  }
  return component;
}

/// Nodes of an icosahedron's edges, urgent ones among them, and integers for them.
struct EdgeSample {
  EdgeForest forest{subdivision_levels(12, shapes::icosahedron().faces, 2)};
  BitplaneLayout layout;
  BitplaneCoefficients integers;

  EdgeSample() {
    Random random(21);
    const SubdivisionLevel base = base_level(12, shapes::icosahedron().faces);
    layout.base_planes = 8;
    layout.detail_planes = kPlanes;
    layout.levels = forest.levels();
    layout.base_neighbours.resize(12);
    for (const auto& [a, b] : base.edges) {
      layout.base_neighbours[a].push_back(b);
      layout.base_neighbours[b].push_back(a);
    }
    layout.urgency = [](const BitplaneCoefficients&) {
      return [](int node) {
        return std::array<std::int8_t, 3>{static_cast<std::int8_t>(node % 9), 0, static_cast<std::int8_t>(-node % 5)};
      };
    };
    for (int v = 0; v < 12; ++v) {
      integers.base.emplace_back();
      for (std::uint32_t& x : integers.base.back()) x = static_cast<std::uint32_t>(random.next() % 256);
    }
    for (auto& component : integers.details) component = random_component(forest.nodes(), random);
  }
};

/// What is known of a component is its magnitudes' bits down to each node's lowest plane, and the signs of those. At
/// the node at which a stream ends the lowest plane is the one that it does not tell any more, taken as 0: returns how
/// many such nodes there are.
int check_known(const BitplaneCoefficients::Component& known, const BitplaneCoefficients::Component& actual) {
  int ends = 0;
  for (std::size_t n = 0; n < known.magnitude.size(); ++n) {
    const int low = known.low_plane[n];
    const std::uint32_t expected = actual.magnitude[n] >> low << low;
    if (known.magnitude[n] != expected) {
      REQUIRE(known.magnitude[n] == (expected & ~(1u << low)));
      ++ends;
    }
    if (known.magnitude[n] != 0) REQUIRE(known.negative[n] == actual.negative[n]);
  }
  return ends;
}

/// A side of the stream that keeps the bits it is given, or says others.
struct NotingSide {
  std::vector<bool> bits;
  bool lie = false;
  bool decide(bool actual, Probability set) {
    CHECK(set == 32768);
    bits.push_back(actual);
    return actual != lie;
  }
};

}  // namespace

TEST_CASE("decisions cost the logarithm of their probability, and as many bits of the stream") {
  Bytes bytes;
  EncodingSide encoding(bytes);
  Random random(6);
  double expected = 0.0;
  std::vector<std::pair<bool, Probability>> decisions;
  for (int k = 0; k < 4000; ++k) {
    const Probability set = 1024 + static_cast<Probability>(random.next() % 63000);
    const bool bit = random.uniform() * 65536.0 < set;
    decisions.push_back({bit, set});
    expected -= std::log2((bit ? set : 65536 - set) / 65536.0);
    if (k == 2000) encoding.count_as(&BitplaneParts::Component::signs, 1);
    encoding.decide(bit, set);
  }
  encoding.finish();
  const double first = encoding.parts().base, second = encoding.parts().details[1].signs;
  CHECK(first + second == Approx(expected).epsilon(1e-3));
  CHECK(first > 0.4 * expected);
  CHECK(second > 0.4 * expected);
  CHECK(std::abs(8.0 * bytes.size() - expected) < 16.0);
  DecodingSide decoding(bytes.data(), bytes.data() + bytes.size());
  for (const auto& [bit, set] : decisions) CHECK(decoding.decide(false, set) == bit);
}

TEST_CASE("news are priced by their probability and a sign, and a size ends the stream") {
  Bytes bytes;
  PricingSide side(bytes, 10, 3);
  side.decide(true, 16384);
  side.note_significance(1, 2);
  // -log2(1/4) + log2(3/4) + 1
  CHECK(side.prices[1][2] == Approx(2.585).margin(0.002));
  CHECK(side.prices[1][1] == BitplaneState::kNoPrice);
  int decisions = 1;
  const auto write_on = [&] {
    for (; decisions < 1000; ++decisions) side.decide(true, 32768);
  };
  CHECK_THROWS_AS(write_on(), StreamEnd);
  CHECK(bytes.size() == 10);
  CHECK(decisions >= 79);
  CHECK(decisions <= 88);
}

TEST_CASE("checks come after 4096 events, later with every eighth of them") {
  PayloadCheck check;
  NotingSide side;
  std::vector<int> due;
  int events = 0;
  const auto step = [&](std::uint32_t event) {
    check.note(event);
    ++events;
    const std::size_t before = side.bits.size();
    check.check_if_due(side);
    if (side.bits.size() == before) return;
    CHECK(side.bits.size() == before + 8);
    due.push_back(events);
  };
  for (int k = 0; k < 50000; ++k) step(static_cast<std::uint32_t>(k));
  // 4096 each up to 8·4096, then by an eighth of all before.
  CHECK(due == std::vector<int>{4096, 8192, 12288, 16384, 20480, 24576, 28672, 32768, 36864, 41472, 46656});
}

TEST_CASE("a check says what the events before it were") {
  const auto check_after = [](std::uint32_t changed, bool lie) {
    PayloadCheck check;
    NotingSide side;
    side.lie = lie;
    for (std::uint32_t k = 0; k < 4096; ++k) check.note(k == 1000 ? changed : 3 * k);
    check.check_if_due(side);
    return side.bits;
  };
  const std::vector<bool> right = check_after(3000, false);
  CHECK(right.size() == 8);
  CHECK(check_after(3000, false) == right);
  int other = 0;
  for (std::uint32_t changed = 0; changed < 20; ++changed) other += check_after(changed, false) != right;
  CHECK(other >= 19);  // one in 256 passes by chance
  CHECK(cause_of([&] { check_after(3000, true); }) == Cause::BadStream);
}

TEST_CASE("a stream of bit-planes comes back as the encoder knows it, whole and cut anywhere") {
  const EdgeSample sample;
  Bytes bytes;
  const BitplaneParts parts = encode_bitplanes(sample.forest, sample.layout, sample.integers, bytes);
  double bits = parts.base + parts.checks;
  for (const auto& c : parts.details) bits += c.trees + c.significance + c.signs + c.refinement;
  CHECK(bits == Approx(8.0 * bytes.size()).epsilon(0.01));
  std::array<std::vector<std::uint8_t>, 3> lowest;
  for (auto& low : lowest) low.assign(sample.forest.nodes(), kPlanes);
  for (std::size_t size = 0; size <= bytes.size(); size += size + 40 < bytes.size() ? 40 : 1) {
    const BitplaneCoefficients known =
        decode_bitplanes(sample.forest, sample.layout, bytes.data(), bytes.data() + size);
    int ends = 0;
    for (int c = 0; c < 3; ++c) {
      ends += check_known(known.details[c], sample.integers.details[c]);
      for (int n = 0; n < sample.forest.nodes(); ++n) REQUIRE(known.details[c].low_plane[n] <= lowest[c][n]);
      lowest[c] = known.details[c].low_plane;
    }
    REQUIRE(ends <= (size < bytes.size()));
    for (int v = 0; v < 12; ++v)
      for (int k = 0; k < 3; ++k) {
        const int low = known.base_low_plane[v][k];
        REQUIRE(known.base[v][k] == sample.integers.base[v][k] >> low << low);
      }
  }
  const BitplaneState state = encode_bitplanes_until(sample.forest, sample.layout, sample.integers, bytes.size() + 100);
  const BitplaneCoefficients whole =
      decode_bitplanes(sample.forest, sample.layout, bytes.data(), bytes.data() + bytes.size());
  // Base positions wait for two passes: their planes end at the third.
  for (const auto& low : whole.base_low_plane) CHECK(low == std::array<std::uint8_t, 3>{3, 3, 3});
  for (int c = 0; c < 3; ++c) {
    CHECK(whole.details[c].magnitude == state.known.details[c].magnitude);
    CHECK(whole.details[c].low_plane == state.known.details[c].low_plane);
  }
}

TEST_CASE("a node's planes end earlier by a plane for four passes less of urgency") {
  EdgeSample sample;
  for (int urgency : {kMaxUrgency, 4, 0, -4}) {
    sample.layout.urgency = [urgency](const BitplaneCoefficients&) {
      return [urgency](int) {
        const auto u = static_cast<std::int8_t>(urgency);
        return std::array<std::int8_t, 3>{u, u, u};
      };
    };
    Bytes bytes;
    encode_bitplanes(sample.forest, sample.layout, sample.integers, bytes);
    const BitplaneCoefficients known =
        decode_bitplanes(sample.forest, sample.layout, bytes.data(), bytes.data() + bytes.size());
    // Bits of what is known already wait for three passes: they end a plane earlier.
    const int last = (kMaxUrgency - urgency) / kPassesPerPlane + 1;
    for (const auto& component : known.details)
      for (int n = 0; n < sample.forest.nodes(); ++n)
        if (component.magnitude[n] != 0) {
          REQUIRE(component.low_plane[n] <= last);
          REQUIRE(component.low_plane[n] >= last - 1);
        }
  }
}

TEST_CASE("a decoder of fewer levels reads the same of those it has, up to where finer ones begin") {
  const EdgeSample sample;
  Bytes bytes;
  encode_bitplanes(sample.forest, sample.layout, sample.integers, bytes);
  const EdgeForest coarse(subdivision_levels(12, shapes::icosahedron().faces, 0));
  const BitplaneCoefficients known = decode_bitplanes(coarse, sample.layout, bytes.data(), bytes.data() + bytes.size());
  int significant = 0;
  for (int c = 0; c < 3; ++c) {
    CHECK(check_known(known.details[c], sample.integers.details[c]) == 0);
    for (std::uint32_t m : known.details[c].magnitude) significant += m != 0;
  }
  CHECK(significant < 10);  // the first one beside which something finer is spoken of ends it
}

TEST_CASE("streams of one number a node come back whole, and every prefix in part") {
  Random random(33);
  for (const Mesh& base : {shapes::icosahedron(), shapes::grid(3, 2)}) {
    const ScalarForest forest(subdivision_levels(base.vertex_count(), base.faces, 2));
    const ScalarIntegers integers = random_component(forest.nodes(), random);
    Bytes bytes;
    const BitplaneParts parts = encode_scalars(forest, kPlanes, integers, bytes);
    double bits = parts.checks;
    for (const auto& c : parts.details) bits += c.trees + c.significance + c.signs + c.refinement;
    CHECK(bits == Approx(8.0 * bytes.size()).epsilon(0.02));
    const ScalarIntegers whole =
        decode_scalars(forest, forest.levels(), kPlanes, bytes.data(), bytes.data() + bytes.size());
    CHECK(whole.magnitude == integers.magnitude);
    for (int n = 0; n < forest.nodes(); ++n)
      if (integers.magnitude[n] != 0) CHECK(whole.negative[n] == integers.negative[n]);
    std::vector<std::uint8_t> lowest(forest.nodes(), kPlanes);
    for (std::size_t size = 0; size < bytes.size(); size += 25) {
      const ScalarIntegers known = decode_scalars(forest, forest.levels(), kPlanes, bytes.data(), bytes.data() + size);
      CHECK(check_known(known, integers) <= 1);
      for (int n = 0; n < forest.nodes(); ++n) REQUIRE(known.low_plane[n] <= lowest[n]);
      lowest = known.low_plane;
    }
  }
}

TEST_CASE("nothing significant costs a few bytes, and one number hardly more than its bits") {
  const ScalarForest forest(subdivision_levels(12, shapes::icosahedron().faces, 3));
  ScalarIntegers integers;
  integers.magnitude.assign(forest.nodes(), 0);
  integers.negative.assign(forest.nodes(), 0);
  Bytes none, one;
  encode_scalars(forest, kPlanes, integers, none);
  integers.magnitude[5] = 1 << (kPlanes - 1);  // of a base vertex
  integers.negative[5] = 1;
  encode_scalars(forest, kPlanes, integers, one);
  CHECK(none.size() < 12u);
  CHECK(one.size() < none.size() + 12u);
  const ScalarIntegers again = decode_scalars(forest, forest.levels(), kPlanes, one.data(), one.data() + one.size());
  CHECK(again.magnitude == integers.magnitude);
  CHECK(again.negative[5] == 1);
}
