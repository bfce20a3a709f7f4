#include "coder/quantizer.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "coder/precision.h"
#include "tests/coder/sample_meshes.h"

using namespace gsp;

namespace {

StreamHeader header_of(Wavelet wavelet, int level) {
  StreamHeader header;
  header.wavelet = wavelet;
  header.level = level;
  return header;
}

/// Every plane known, and signs as they are.
void know_all(BitplaneCoefficients& integers) {
  integers.base_low_plane.assign(integers.base.size(), {0, 0, 0});
  for (BitplaneCoefficients::Component& c : integers.details) c.low_plane.assign(c.magnitude.size(), 0);
}

/// A unit square of two faces, quadrisected once, its edges' middles raised by `height`.
std::vector<Vec3> raised_square(double height) {
  SemiregularMesh mesh = samples::refine(shapes::grid(1, 1), 1, [](const Vec3& p) { return p; });
  for (std::size_t v = 4; v < mesh.positions.size(); ++v) mesh.positions[v].z() = height;
  return mesh.positions;
}

}  // namespace

TEST_CASE("details become whole steps toward zero, and steps double from level to level") {
  StreamHeader header = header_of(Wavelet::Butterfly, 2);
  // A diagonal of 1 at 4 bits, and two bits to spare: the finest step is 1/64, that of the base's edges 1/128.
  const std::vector<Vec3> base = {{0, 0, 0}, {0.5, 0.25, 0}};
  const std::vector<std::vector<Vec3>> details = {{{3.5 / 128, -2.0 / 128, 0.0}},
                                                  {{3.5 / 64, -0.5 / 64, 7.0 / 64}, {0.0, 1.0 / 64, -1.99 / 64}}};
  const BitplaneCoefficients integers = quantize(base, details, 1.0, 4, header);
  CHECK(header.step_exponent == -6);
  CHECK(integers.details[0].magnitude == std::vector<std::uint32_t>{3, 3, 0});
  CHECK(integers.details[1].magnitude == std::vector<std::uint32_t>{2, 0, 1});
  CHECK(integers.details[2].magnitude == std::vector<std::uint32_t>{0, 7, 1});
  CHECK(integers.details[1].negative == std::vector<std::uint8_t>{1, 1, 0});
  CHECK(integers.details[2].negative == std::vector<std::uint8_t>{0, 0, 1});
  CHECK(header.detail_planes == 3);  // 7 is the largest
}

TEST_CASE("base positions lie within half a step of what is known of them once all planes are") {
  for (const Wavelet wavelet : kWavelets) {
    StreamHeader header = header_of(wavelet, 3);
    Random random(8);
    std::vector<Vec3> base(50);
    for (Vec3& p : base)
      for (double& x : p) x = 100.0 + 3.0 * random.uniform();
    BitplaneCoefficients integers = quantize(base, {}, 5.0, 10, header);
    CHECK(header.step_exponent == 2 - 10 - 2);
    const double step = std::ldexp(1.0, header.step_exponent - 3) * wavelet_norm(wavelet);
    know_all(integers);
    const std::vector<Vec3> again = dequantize_base(integers, header);
    double largest = 0.0;
    for (std::size_t v = 0; v < base.size(); ++v)
      largest = std::max(largest, (again[v] - base[v]).cwiseAbs().maxCoeff());
    CHECK(largest <= 0.5 * step * (1.0 + 1e-9));
    CHECK(largest > 0.4 * step);
    // Of every coordinate the planes below the third are unknown: the middle of eight steps.
    for (auto& low : integers.base_low_plane) low = {3, 3, 3};
    for (auto& v : integers.base)
      for (std::uint32_t& x : v) x &= ~7u;
    for (std::size_t v = 0; v < base.size(); ++v)
      CHECK((dequantize_base(integers, header)[v] - base[v]).cwiseAbs().maxCoeff() <= 4.0 * step * (1.0 + 1e-9));
  }
}

TEST_CASE("a detail comes back inside its interval, at 0.47 of its first bit's and 0.55 of others") {
  CHECK(centroid(1, 0) == 1.47);
  CHECK(centroid(2, 0) == 2.55);
  CHECK(centroid(8, 3) == 8 + 0.47 * 8);
  CHECK(centroid(24, 3) == 24 + 0.55 * 8);
  const EdgeForest forest(subdivision_levels(3, {{0, 1, 2}}, 1));
  StreamHeader header = header_of(Wavelet::Loop, 2);
  header.step_exponent = -1;
  BitplaneCoefficients integers;
  for (BitplaneCoefficients::Component& c : integers.details) {
    c.magnitude.assign(forest.nodes(), 0);
    c.negative.assign(forest.nodes(), 0);
    c.low_plane.assign(forest.nodes(), 0);
  }
  integers.details[0].magnitude[1] = 6;  // a base edge, of step 1/4
  integers.details[0].low_plane[1] = 1;
  integers.details[2].magnitude[3] = 1;  // the first edge of level 1, of step 1/2
  integers.details[2].negative[3] = 1;
  const auto coarse = dequantize_details(integers, forest, 0, header);
  const auto fine = dequantize_details(integers, forest, 1, header);
  REQUIRE(coarse.size() == 3);
  REQUIRE(fine.size() == 9);
  CHECK(coarse[0] == Vec3(0, 0, 0));
  CHECK(coarse[1] == Vec3((6 + 0.55 * 2) / 4, 0, 0));
  CHECK(fine[0] == Vec3(0, 0, -1.47 / 2));
}

TEST_CASE("planes are as many as a base needs, however far from the origin and however large") {
  for (double place : {0.0, 1.0, 1e6}) {
    StreamHeader header = header_of(Wavelet::Butterfly, 4);
    const std::vector<Vec3> base = {{place, place, place}, {place + 1, place + 0.5, place}};
    const int bits = most_precision_bits(4);
    BitplaneCoefficients integers = quantize(base, {}, 1.0, bits, header);
    CHECK(header.base_planes <= 31);
    // A step is 2^-(bits + 2 + 4), the origin's unit an eighth of the range.
    CHECK(header.base_planes >= bits + 6);
    know_all(integers);
    CHECK((dequantize_base(integers, header)[1] - base[1]).cwiseAbs().maxCoeff() < 1e-8);
  }
}

TEST_CASE("precision follows the height of the finest vertices over their edges in quarters of a bit") {
  const SubdivisionLevel square = base_level(4, shapes::grid(1, 1).faces);
  // Steps are a 48th of the height: 2^-9 here, of a diagonal in [1, 2).
  const double height = 48.0 / 512.0, quarter = std::pow(2.0, 0.25);
  CHECK(sufficient_precision(square, raised_square(height / 256), 1.5) == 4 * 17);
  CHECK(sufficient_precision(square, raised_square(1.001 * height / 256 / quarter), 1.5) == 4 * 17 + 1);
  CHECK(sufficient_precision(square, raised_square(-1.001 * height / 256 / (quarter * quarter)), 1.5) == 4 * 17 + 2);
  CHECK(sufficient_precision(square, raised_square(height / 256), 2.5) == 4 * 18);
  CHECK(sufficient_precision(square, raised_square(0.999 * height / 256), 1.5) == 4 * 17 + 1);
  // From 16 bits to 24, which flat surfaces have.
  CHECK(sufficient_precision(square, raised_square(height), 1.5) == 4 * 16);
  CHECK(sufficient_precision(square, raised_square(height * 1e-9), 1.5) == 4 * 24);
  CHECK(sufficient_precision(square, raised_square(0.0), 1.5) == 4 * 24);
  CHECK(sufficient_precision(square, std::vector<Vec3>(9, Vec3::Zero()), 0.0) == 4 * 16);
}
