#include "coder/codec.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "coder/base_connectivity.h"
#include "coder/coded_order.h"
#include "coder/header.h"
#include "coder/rate_distortion.h"
#include "tests/cause_of.h"
#include "tests/coder/scalar_meshes.h"

using namespace gsp;

namespace {

Progress silent;

/// RMS over vertices between a mesh and its decoded form, which is in coded order.
double rms_error(const SemiregularMesh& mesh, const SemiregularMesh& decoded) {
  Bytes unused;
  const std::vector<int> order = coded_vertex_order(mesh, encode_connectivity(mesh.base_faces, unused));
  REQUIRE(order.size() == decoded.positions.size());
  double sum = 0.0;
  for (std::size_t v = 0; v < order.size(); ++v) sum += (decoded.positions[v] - mesh.positions[order[v]]).squaredNorm();
  return std::sqrt(sum / order.size());
}

}  // namespace

TEST_CASE("the whole stream holds the mesh to its precision") {
  for (const SemiregularMesh& mesh :
       {samples::bumpy_sphere(4), samples::wavy_sheet(3), samples::noise(shapes::icosahedron(), 0)}) {
    const double diagonal = bounding_box_diagonal(mesh.mesh());
    for (int bits : {10, 16, 22}) {
      EncodeOptions options;
      options.precision_bits = bits;
      const Bytes stream = encode(mesh, options, silent);
      // Tangential components may end coarser than normal ones.
      CHECK(rms_error(mesh, decode(stream, stream.size())) < 8.0 * std::ldexp(diagonal, -bits));
    }
  }
}

TEST_CASE("by default the whole stream is within 0.1 dB of what its remesh can show, on a sphere as well", "[slow]") {
  // Nothing is smoother than a sphere: no surface is nearer to a mesh whose edges' middles rise as high.
  const auto mean_and_rms = [](const Mesh& mesh) {
    constexpr int kSteps = 6;
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (const Triangle& t : mesh.faces)
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; i + j < kSteps; ++j) {
          const double a = (i + 1.0 / 3) / kSteps, b = (j + 1.0 / 3) / kSteps;
          const Vec3 p = a * mesh.positions[t[0]] + b * mesh.positions[t[1]] + (1 - a - b) * mesh.positions[t[2]];
          sum += p.norm();
          squares += (p.norm() - 1.0) * (p.norm() - 1.0);
          ++count;
        }
    return std::pair(sum / count, std::sqrt(squares / count));
  };
  for (Wavelet wavelet : kWavelets)
    for (int level : {2, 4, 5, 6}) {
      SemiregularMesh mesh =
          samples::refine(shapes::icosahedron(), level, [](const Vec3& p) { return Vec3(p.normalized()); });
      const double mean = mean_and_rms(mesh.mesh()).first;
      for (Vec3& p : mesh.positions) p /= mean;
      EncodeOptions options;
      options.wavelet = wavelet;
      const Bytes stream = encode(mesh, options, silent);
      const double whole = mean_and_rms(decode(stream, stream.size()).mesh()).second;
      CHECK(20.0 * std::log10(whole / mean_and_rms(mesh.mesh()).second) < (wavelet == Wavelet::Butterfly ? 0.16 : 0.1));
    }
}

TEST_CASE("a whole stream that ends between two bits of precision is a prefix of the longer one's", "[slow]") {
  for (const SemiregularMesh& mesh : {samples::bumpy_sphere(5), samples::wavy_sheet(5)}) {
    const Bytes stream = encode(mesh, {}, silent);
    std::size_t shared = 0, longer_size = 0;
    for (int bits = 16; bits <= 24 && shared < stream.size(); ++bits) {
      EncodeOptions options;
      options.precision_bits = bits;
      const Bytes longer = encode(mesh, options, silent);
      if (longer.size() < stream.size()) continue;
      longer_size = longer.size();
      shared = std::mismatch(stream.begin(), stream.end(), longer.begin()).first - stream.begin();
    }
    CHECK(shared == stream.size());
    CHECK(longer_size > stream.size());
  }
}

TEST_CASE("a decoded mesh is coded to itself, bit for bit the same every time") {
  const SemiregularMesh mesh = samples::bumpy_sphere(3);
  const Bytes stream = encode(mesh, {}, silent);
  CHECK(encode(mesh, {}, silent) == stream);
  const SemiregularMesh once = decode(stream, stream.size()), twice = decode(stream, stream.size());
  CHECK(once.positions == twice.positions);
  CHECK(once.base_faces == twice.base_faces);
  CHECK(once.mesh().faces.size() == mesh.mesh().faces.size());
}

TEST_CASE("the parts of a stream add up to it") {
  StreamParts parts;
  const Bytes stream = encode(samples::bumpy_sphere(4), {}, silent, &parts);
  CHECK(parts.header_bytes + parts.connectivity_bytes == header_bytes(stream));
  double bits = parts.bits.base + parts.bits.checks;
  for (const BitplaneParts::Component& c : parts.bits.details)
    bits += c.trees + c.significance + c.signs + c.refinement;
  CHECK(bits / 8.0 == Approx(stream.size() - header_bytes(stream)).epsilon(0.005));
}

TEST_CASE("tangential components of a normal mesh cost nothing, and those of an exception next to nothing else") {
  SemiregularMesh mesh = samples::scalar(shapes::icosahedron(), 5, 0.2);
  EncodeOptions options;
  options.wavelet = Wavelet::Butterfly;
  StreamParts parts;
  const Bytes stream = encode(mesh, options, silent, &parts);
  const auto bits = [&](int c) {
    const BitplaneParts::Component& part = parts.bits.details[c];
    return part.trees + part.significance + part.signs + part.refinement;
  };
  CHECK(bits(0) > 0.9 * 8.0 * stream.size());
  CHECK(bits(1) + bits(2) == 0.0);
  CHECK(rms_error(mesh, decode(stream, stream.size())) < 1e-5);
  // One vertex off its normal, and the stream has three components: they are found where they are.
  mesh.positions[mesh.positions.size() / 2] += Vec3(0.01, 0.02, 0.03);
  const Bytes excepted = encode(mesh, options, silent, &parts);
  CHECK(bits(1) + bits(2) > 0.0);
  CHECK(bits(1) + bits(2) < 0.01 * bits(0));
  CHECK(rms_error(mesh, decode(excepted, excepted.size())) < 1e-5);
}

TEST_CASE("a scalar stream keeps the three components of its boundary, in every mode, to every prefix") {
  const SemiregularMesh mesh = samples::scalar(shapes::grid(3, 4), 3, 0.3);
  EncodeOptions options;
  options.wavelet = Wavelet::Butterfly;
  options.precision_bits = 16;
  const Bytes stream = encode(mesh, options, silent);
  CHECK(read_header(stream.data(), stream.data() + stream.size()).kind == StreamKind::Normal);
  CHECK(rms_error(mesh, decode(stream, stream.size())) < 2e-4);
  const Bytes fixed = encode_fixed(mesh, options, 4 * stream.size(), silent);
  CHECK(rms_error(mesh, decode(fixed, fixed.size())) < 2e-4);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t bytes = header_bytes(stream); bytes <= stream.size(); bytes += stream.size() / 8) {
    const double error = rms_error(mesh, decode(stream, bytes));
    CHECK(error < 1.2 * least);
    least = std::min(least, error);
  }
}

TEST_CASE("a stream of another version or an unknown kind is refused") {
  const Bytes stream = encode(samples::bumpy_sphere(1), {}, silent);
  for (int version : {0, 5, 6, 7, 8, 10, 255}) {
    Bytes other = stream;
    other[3] = static_cast<std::uint8_t>(version);
    CHECK(cause_of([&] { decode(other, other.size()); }) == Cause::BadStream);
  }
  for (int kind : {2, 3}) {
    Bytes other = stream;
    other[9] |= static_cast<std::uint8_t>(kind << 6);
    seal_header(other);
    CHECK(cause_of([&] { decode(other, other.size()); }) == Cause::BadStream);
  }
}

TEST_CASE("every prefix that holds the header decodes, and more bytes are better") {
  const SemiregularMesh mesh = samples::bumpy_sphere(4);
  const Bytes stream = encode(mesh, {}, silent);
  const std::size_t header = header_bytes(stream);
  double last = std::numeric_limits<double>::infinity();
  for (std::size_t bytes = header; bytes <= stream.size(); bytes += 1 + bytes / 3) {
    const double error = rms_error(mesh, decode(stream, bytes));
    CHECK(error < 1.1 * last);
    last = std::min(last, error);
  }
  CHECK(last < 0.01);
  const Bytes cut(stream.begin(), stream.begin() + header + 100);
  CHECK(decode(cut, cut.size()).positions == decode(stream, header + 100).positions);
  CHECK(cause_of([&] { decode(stream, header - 1); }) == Cause::Truncated);
  CHECK(cause_of([&] { decode({}, 0); }) == Cause::BadStream);
}

TEST_CASE("a stream for one size keeps to it and is nearer than the embedded one's prefix", "[slow]") {
  for (const SemiregularMesh& mesh : {samples::bumpy_sphere(5), samples::wavy_sheet(4)}) {
    Bytes unused;
    const SurfaceError error(in_coded_order(mesh, encode_connectivity(mesh.base_faces, unused)).mesh());
    double ratio = 1.0;
    const Bytes embedded = encode(mesh, {}, silent);
    for (std::size_t bytes : {300, 600, 1200}) {
      const Bytes fixed = encode_fixed(mesh, {}, bytes, silent);
      CHECK(fixed.size() == bytes);
      CHECK(encode_fixed(mesh, {}, bytes, silent) == fixed);
      ratio *= error.of(decode(fixed, bytes).positions) / error.of(decode(embedded, bytes).positions);
    }
    CHECK(ratio < 1.0);
    const std::size_t ample = 2 * embedded.size();
    const Bytes whole = encode_fixed(mesh, {}, ample, silent);
    CHECK(whole.size() < ample);
    CHECK(rms_error(mesh, decode(whole, ample)) < 1.1 * rms_error(mesh, decode(embedded, ample)));
    const std::size_t header = header_bytes(embedded);
    CHECK(decode(encode_fixed(mesh, {}, header, silent), header).level == mesh.level);
    CHECK(cause_of([&] { encode_fixed(mesh, {}, header - 1, silent); }) == Cause::BadOption);
  }
}

TEST_CASE("more bytes are never much worse, wherever the stream is cut", "[slow]") {
  const SemiregularMesh mesh = samples::bumpy_sphere(4);
  Bytes unused;
  const SurfaceError error(in_coded_order(mesh, encode_connectivity(mesh.base_faces, unused)).mesh());
  for (Wavelet wavelet : {Wavelet::Loop, Wavelet::ButterflyLifted}) {
    EncodeOptions options;
    options.wavelet = wavelet;
    const Bytes stream = encode(mesh, options, silent);
    const std::size_t header = header_bytes(stream);
    Random random(7);
    std::vector<std::size_t> cuts;
    for (int i = 0; i < 200; ++i) cuts.push_back(header + random.next() % (stream.size() - header + 1));
    std::sort(cuts.begin(), cuts.end());
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t bytes : cuts) {
      const double here = error.of(decode(stream, bytes).positions);
      CHECK(10.0 * std::log10(here / best) < 0.05);
      best = std::min(best, here);
    }
  }
}

TEST_CASE("options and meshes that cannot be coded are refused") {
  SemiregularMesh mesh = samples::bumpy_sphere(1);
  const auto refusal = [&](EncodeOptions options) { return cause_of([&] { encode(mesh, options, silent); }); };
  CHECK(refusal({Wavelet::Loop, 7, 4}) == Cause::BadOption);
  CHECK(refusal({Wavelet::Loop, 25, 4}) == Cause::BadOption);
  CHECK(refusal({Wavelet::Loop, 16, 3}) == Cause::BadOption);
  CHECK(refusal({Wavelet::Loop, 16, 16}) == Cause::BadOption);
  mesh.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal({}) == Cause::NonFinite);
  CHECK(cause_of([&] { encode({}, {}, silent); }) == Cause::NoFaces);
}

TEST_CASE("the finest precision fits at the deepest level", "[slow]") {
  SemiregularMesh mesh = samples::refine(shapes::tetrahedron(), 7, [](const Vec3& p) { return Vec3(p.normalized()); });
  EncodeOptions options;
  options.precision_bits = 24;
  const Bytes stream = encode(mesh, options, silent);
  CHECK(rms_error(mesh, decode(stream, stream.size())) <
        4.0 * std::ldexp(bounding_box_diagonal(mesh.mesh()), -(25 - 7)));
}

TEST_CASE("degenerate geometry and extreme places are coded") {
  const double tolerance = 1e-3;
  SemiregularMesh point = samples::refine(shapes::icosahedron(), 2, [](const Vec3&) { return Vec3(3, 4, 5); });
  Bytes stream = encode(point, {}, silent);
  CHECK(rms_error(point, decode(stream, stream.size())) < 1e-6);
  EncodeOptions finest;
  finest.precision_bits = 24;
  stream = encode(point, finest, silent);
  CHECK(rms_error(point, decode(stream, stream.size())) < 1e-6);
  SemiregularMesh far =
      samples::refine(shapes::icosahedron(), 2, [](const Vec3& p) { return Vec3(p + Vec3(1e6, -1e6, 1e6)); });
  stream = encode(far, {}, silent);
  CHECK(rms_error(far, decode(stream, stream.size())) < tolerance);
  SemiregularMesh tiny = samples::refine(shapes::icosahedron(), 2, [](const Vec3& p) { return Vec3(p * 1e-30); });
  stream = encode(tiny, {}, silent);
  CHECK(rms_error(tiny, decode(stream, stream.size())) < 1e-30 * tolerance);
}

TEST_CASE("an altered header is a bad stream, an altered body is noticed or some mesh") {
  const SemiregularMesh mesh = samples::bumpy_sphere(2);
  const Bytes stream = encode(mesh, {}, silent);
  const std::size_t header = header_bytes(stream);
  for (std::size_t byte = 0; byte < header; ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      Bytes damaged = stream;
      damaged[byte] ^= 1 << bit;
      const Cause cause = cause_of([&] { decode(damaged, damaged.size()); });
      CHECK((cause == Cause::BadStream || cause == Cause::Truncated));
    }
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes damaged = stream;
    for (int flips = 0; flips < 3; ++flips)
      damaged[header + random.next() % (stream.size() - header)] ^= 1 << random.next() % 8;
    try {
      const SemiregularMesh decoded = decode(damaged, damaged.size());
      CHECK(decoded.positions.size() == mesh.positions.size());
      for (const Vec3& p : decoded.positions) REQUIRE(p.allFinite());
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::BadStream);
    }
  }
}

TEST_CASE("damage before the last eighth of a long payload is noticed, and the prefix before it still decodes") {
  const Bytes stream = encode(samples::noise(shapes::icosahedron(), 4), {}, silent);
  const std::size_t header = header_bytes(stream), payload = stream.size() - header;
  REQUIRE(payload > 12000);
  Random random(9);
  int missed = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::size_t byte = header + random.next() % (payload * 3 / 4);
    Bytes damaged = stream;
    damaged[byte] ^= 1 << random.next() % 8;
    try {
      decode(damaged, damaged.size());
      ++missed;
    } catch (const Error& error) {
      CHECK(error.cause() == Cause::BadStream);
    }
    CHECK(decode(damaged, byte).positions == decode(stream, byte).positions);
  }
  CHECK(missed == 0);
}
