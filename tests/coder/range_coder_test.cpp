#include "coder/range_coder.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "coder/bit_model.h"
#include "coder/context_values.h"
#include "mesh/random.h"

using namespace gsp;

namespace {

struct Sample {
  std::vector<bool> bits;
  std::vector<Probability> probabilities;
  double entropy = 0.0;
  std::vector<std::uint8_t> coded;
};

/// Bits drawn from known probabilities, extreme ones included.
Sample sample(std::uint64_t seed, int count) {
  Sample s;
  Random random(seed);
  RangeEncoder encoder(s.coded);
  for (int i = 0; i < count; ++i) {
    const Probability p = i % 7 == 0 ? 65535 : i % 5 == 0 ? 1 : 1 + random.next() % 65535;
    const bool bit = random.uniform() < p / 65536.0;
    s.bits.push_back(bit);
    s.probabilities.push_back(p);
    s.entropy -= std::log2(bit ? p / 65536.0 : 1.0 - p / 65536.0);
    encoder.encode(bit, p);
  }
  encoder.finish();
  return s;
}

/// Bits that a prefix yields before it ends.
std::size_t decoded_bits(const Sample& s, std::size_t bytes) {
  RangeDecoder decoder(s.coded.data(), s.coded.data() + bytes);
  std::size_t i = 0;
  try {
    for (; i < s.bits.size(); ++i) {
      const bool bit = decoder.decode(s.probabilities[i]);
      REQUIRE(bit == s.bits[i]);
    }
  } catch (const StreamEnd&) {
  }
  return i;
}

}  // namespace

TEST_CASE("range coding comes within two bytes of the entropy and back") {
  for (int count : {0, 1, 10, 5000}) {
    const Sample s = sample(count + 1, count);
    CHECK(s.coded.size() <= s.entropy / 8 + 2.0);
    CHECK(decoded_bits(s, s.coded.size()) == s.bits.size());
  }
}

TEST_CASE("a prefix yields right bits only, and all that it settles") {
  const Sample s = sample(9, 3000);
  std::size_t before = 0;
  for (std::size_t bytes = 0; bytes <= s.coded.size(); ++bytes) {
    const std::size_t bits = decoded_bits(s, bytes);
    CHECK(bits >= before);
    before = bits;
  }
  double entropy = 0.0;
  const std::size_t half = s.coded.size() / 2, bits = decoded_bits(s, half);
  for (std::size_t i = 0; i < bits; ++i) {
    const double p = s.probabilities[i] / 65536.0;
    entropy -= std::log2(s.bits[i] ? p : 1.0 - p);
  }
  CHECK(entropy > 8.0 * half - 20.0);
}

TEST_CASE("stretch and squash are inverse to their resolution") {
  for (int logit = -2800; logit <= 2800; logit += 7) {
    const Probability p = Logistic::squash(logit);
    CHECK(std::abs(p / 65536.0 - 1.0 / (1.0 + std::exp(-logit / 256.0))) < 0.008);
    if (std::abs(logit) < 1200) CHECK(std::abs(Logistic::stretch(p) - logit) < 64);
  }
}

TEST_CASE("octaves and half octaves start where they say") {
  // The first of each class, in quarters of the threshold.
  const std::uint64_t octaves[] = {0, 1, 2, 4, 8, 16}, half_octaves[] = {0, 1, 2, 3, 4, 6, 8, 12, 16};
  for (int plane : {2, 7, 30}) {
    const std::uint64_t quarter = std::uint64_t{1} << (plane - 2);
    for (int k = 1; k < 6; ++k) {
      CHECK(octave(octaves[k] * quarter, plane, 20) == k);
      CHECK(octave(octaves[k] * quarter - 1, plane, 20) == k - 1);
    }
    for (int k = 1; k < 9; ++k) {
      CHECK(half_octave(half_octaves[k] * quarter, plane, 20) == k);
      CHECK(half_octave(half_octaves[k] * quarter - 1, plane, 20) == k - 1);
    }
    CHECK(octave(100 * quarter, plane, 3) == 2);
    CHECK(half_octave(100 * quarter, plane, 3) == 2);
  }
}
