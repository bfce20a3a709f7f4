#include <catch2/catch.hpp>
#include <cmath>

#include "coder/codec.h"
#include "coder/coded_order.h"
#include "coder/displaced/control_points.h"
#include "coder/displaced/displaced_codec.h"
#include "coder/displaced/scalar_field.h"
#include "coder/header.h"
#include "mesh/error.h"
#include "mesh/parallel.h"
#include "mesh/random.h"
#include "tests/cause_of.h"
#include "tests/coder/displaced_meshes.h"

using namespace gsp;

namespace {

Bytes displaced_stream_of(const SemiregularMesh& mesh, int bits, Wavelet wavelet = Wavelet::ButterflyLifted) {
  Progress silent;
  EncodeOptions options;
  options.wavelet = wavelet;
  options.precision_bits = bits;
  return encode(mesh, options, silent);
}

/// Of the decoded vertices from those that were coded: root of the mean square, and the largest.
std::pair<double, double> errors(const SemiregularMesh& mesh, const Bytes& stream, std::size_t bytes) {
  const SemiregularMesh decoded = decode(stream, bytes);
  const StreamHeader header = read_header(stream.data(), stream.data() + stream.size());
  Bytes unused;
  const std::vector<int> order = coded_vertex_order(mesh, encode_connectivity(mesh.base_faces, unused));
  REQUIRE(decoded.positions.size() == order.size());
  double sum = 0.0, most = 0.0;
  for (std::size_t v = 0; v < order.size(); ++v) {
    const double off = (decoded.positions[v] - mesh.positions[order[v]]).norm();
    sum += off * off;
    most = std::max(most, off);
  }
  return {std::sqrt(sum / static_cast<double>(order.size())), most};
}

const std::vector<Mesh>& bases() {
  static const std::vector<Mesh> kBases = {shapes::icosahedron(), shapes::torus(6, 4), shapes::grid(3, 4)};
  return kBases;
}

}  // namespace

TEST_CASE("control points come back whatever they are") {
  Random random(7);
  for (const Mesh& mesh : {shapes::icosahedron(), shapes::torus(9, 7), shapes::grid(6, 5),
                           shapes::twice(shapes::tetrahedron(), Vec3(3, 0, 0))})
    for (int planes : {0, 1, 8, kMostControlPlanes}) {
      Bytes connectivity, bytes;
      const CodedBase base = encode_connectivity(mesh.faces, connectivity);
      std::vector<ControlSteps> points(base.vertices);
      for (ControlSteps& p : points)
        for (auto& x : p) x = static_cast<std::uint32_t>(random.uniform() * std::ldexp(1.0, planes));
      encode_control(base, planes, points, bytes);
      CHECK(decode_control(base, planes, bytes.data(), bytes.data() + bytes.size()) == points);
      if (planes == 0) CHECK(bytes.size() < 4u);
      // Cut short, they are refused.
      if (planes == 8)
        CHECK(cause_of([&] { decode_control(base, planes, bytes.data(), bytes.data() + bytes.size() / 2); }) ==
              Cause::BadStream);
    }
}

TEST_CASE("control points at one place cost next to nothing, on a lattice less than half of their bits") {
  const Mesh grid = shapes::grid(20, 20);
  Bytes connectivity;
  const CodedBase base = encode_connectivity(grid.faces, connectivity);
  const auto size = [&](double x_step, double y_step) {
    std::vector<ControlSteps> points;
    for (int v : base.source_vertex) {
      const Vec3& p = grid.positions[v];
      points.push_back({static_cast<std::uint32_t>(x_step * p.x()), static_cast<std::uint32_t>(y_step * p.y()), 77});
    }
    Bytes bytes;
    encode_control(base, 8, points, bytes);
    return bytes.size();
  };
  // 441 points of 24 bits are 1,323 bytes.
  CHECK(size(0.0, 0.0) < 25u);
  CHECK(size(10.0, 9.0) < 600u);
}

TEST_CASE("a scalar field's coefficients bring it back, and inside nothing is across") {
  for (const Mesh& base : bases())
    for (Wavelet wavelet : {Wavelet::Butterfly, Wavelet::ButterflyLifted, Wavelet::Loop}) {
      const auto levels = subdivision_levels(base.vertex_count(), base.faces, 3);
      const ScalarForest forest(levels);
      const ScalarField field(levels, forest, wavelet);
      Random random(5);
      Displacements numbers;
      const auto fans = vertex_fans(levels.back());
      int boundary = 0;
      for (const VertexFan& fan : fans) {
        numbers.along.push_back(random.uniform() - 0.5);
        numbers.across.push_back(fan.sharp_count == 2 ? random.uniform() - 0.5 : 0.0);
        boundary += fan.sharp_count == 2;
      }
      CHECK(forest.nodes() == levels.back().vertex_count + boundary);
      const Displacements back = field.synthesis(field.analysis(numbers));
      for (std::size_t v = 0; v < fans.size(); ++v) {
        CHECK(std::abs(back.along[v] - numbers.along[v]) < 1e-10);
        CHECK(std::abs(back.across[v] - numbers.across[v]) < 1e-10);
      }
    }
}

TEST_CASE("the nodes of a scalar forest belong together") {
  for (const Mesh& base : bases()) {
    const auto levels = subdivision_levels(base.vertex_count(), base.faces, 3);
    const ScalarForest forest(levels);
    std::vector<int> seen(forest.nodes(), 0);
    for (const ScalarForest::Group& group : forest.groups)
      for (int n = group.begin; n < group.end; ++n) {
        ++seen[n];
        CHECK((n >= forest.vertices) == group.across);
        for (int w : forest.neighbours[n])
          if (w >= 0) CHECK((w >= group.begin && w < group.end));
        for (int child : forest.children[n])
          if (child >= 0) CHECK(forest.parent[child] == n);
        if (forest.parent[n] >= 0) {
          const auto& children = forest.children[forest.parent[n]];
          CHECK(std::find(children.begin(), children.end(), n) != children.end());
        }
      }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  }
}

TEST_CASE("a whole displaced stream gives every coefficient to its step, and the control points exactly") {
  for (const Mesh& base : bases())
    for (Wavelet wavelet : kWavelets) {
      const SemiregularMesh mesh = samples::displaced(base, 3);
      const Bytes stream = displaced_stream_of(mesh, 14, wavelet);
      const StreamHeader header = read_header(stream.data(), stream.data() + stream.size());
      CHECK(header.kind == StreamKind::Displaced);
      const SemiregularMesh coded = in_coded_order(mesh, header.base.source_vertex.empty()
                                                             ? [&] {
                                                                 Bytes unused;
                                                                 return encode_connectivity(mesh.base_faces, unused);
                                                               }()
                                                             : header.base);
      const SemiregularMesh decoded = decode(stream, stream.size());
      REQUIRE(decoded.control);
      CHECK(decoded.control->points == coded.control->points);
      CHECK(decoded.control->grid == coded.control->grid);
      const auto levels = subdivision_levels(coded.base_vertices, coded.base_faces, 3);
      const ScalarForest forest(levels);
      const ScalarField field(levels, forest, wavelet);
      const auto weights = field.weights(coded.control->points, 3, 3);
      const auto expected = field.analysis(displaced_form(coded).displacements);
      const auto found = field.analysis(displaced_form(decoded).displacements);
      const double step = std::ldexp(1.0, header.step_exponent);
      CHECK(step < 1e-3);
      for (int n = 0; n < forest.nodes(); ++n) CHECK(std::abs(found[n] - expected[n]) * weights[n] < 1.001 * step);
    }
}

TEST_CASE("four bits more leave about a sixteenth of the error of a displaced stream") {
  for (const Mesh& base : bases()) {
    const SemiregularMesh mesh = samples::displaced(base, 3);
    const Bytes coarse = displaced_stream_of(mesh, 17), fine = displaced_stream_of(mesh, 21);
    const double ratio = errors(mesh, coarse, coarse.size()).first / errors(mesh, fine, fine.size()).first;
    CHECK(ratio > 12.0);
    CHECK(ratio < 21.0);
  }
}

TEST_CASE("any prefix of a displaced stream that holds the header decodes, and longer ones are nearer") {
  for (const Mesh& base : bases()) {
    const SemiregularMesh mesh = samples::displaced(base, 4);
    const Bytes stream = displaced_stream_of(mesh, 14);
    const std::size_t header = header_bytes(stream);
    CHECK(cause_of([&] { decode(stream, header - 1); }) == Cause::Truncated);
    double last = errors(mesh, stream, header).first;
    for (double part : {0.1, 0.2, 0.35, 0.5, 0.75, 1.0}) {
      const auto bytes = header + static_cast<std::size_t>(part * static_cast<double>(stream.size() - header));
      const double here = errors(mesh, stream, bytes).first;
      CHECK(here < last);
      last = here;
    }
    // Byte by byte too, up to what a bit alone may do.
    for (std::size_t bytes = header; bytes < stream.size(); bytes += 13) CHECK(decode(stream, bytes).level == 4);
  }
}

TEST_CASE("a displaced stream of fixed size is a prefix of the embedded one") {
  const SemiregularMesh mesh = samples::displaced(shapes::torus(6, 4), 3);
  Progress silent;
  EncodeOptions options;
  options.wavelet = Wavelet::ButterflyLifted;
  const Bytes whole = encode(mesh, options, silent), fixed = encode_fixed(mesh, options, 500, silent);
  CHECK(fixed.size() == 500);
  CHECK(std::equal(fixed.begin(), fixed.end(), whole.begin()));
  CHECK(cause_of([&] { encode_fixed(mesh, options, 10, silent); }) == Cause::BadOption);
}

TEST_CASE("displaced streams and what they decode to are the same for any number of threads") {
  const SemiregularMesh mesh = samples::displaced(shapes::grid(3, 4), 4);
  std::vector<Bytes> streams;
  std::vector<SemiregularMesh> decoded;
  for (int threads : {1, 2}) {
    set_thread_count(threads);
    streams.push_back(displaced_stream_of(mesh, 14));
    decoded.push_back(decode(streams[0], streams[0].size() / 2));
  }
  CHECK(streams[0] == streams[1]);
  CHECK(decoded[0].positions == decoded[1].positions);
}

TEST_CASE("a decoded displaced mesh codes to the same mesh again") {
  const SemiregularMesh mesh = samples::displaced(shapes::grid(3, 4), 3);
  const Bytes stream = displaced_stream_of(mesh, 12);
  const SemiregularMesh once = decode(stream, stream.size());
  const Bytes again = displaced_stream_of(once, 16);
  CHECK(errors(once, again, again.size()).second < 1e-4);
}

TEST_CASE("a displaced stream's prefix too short for its finest level decodes to a coarser one, and says the same",
          "[slow]") {
  const SemiregularMesh mesh = samples::displaced(shapes::icosahedron(), 8);
  const Bytes stream = displaced_stream_of(mesh, 16);
  const std::size_t header = header_bytes(stream);
  REQUIRE(stream.size() > header + 640);
  const SemiregularMesh coarse = decode(stream, header + 400), fine = decode(stream, header + 640);
  CHECK(coarse.level == 7);
  CHECK(fine.level == 8);
  for (std::size_t v = 0; v < coarse.positions.size(); v += 97)
    CHECK((coarse.positions[v] - fine.positions[v]).norm() < 0.05);
}

TEST_CASE("damaged displaced streams decode or are refused by name") {
  const SemiregularMesh mesh = samples::displaced(shapes::grid(3, 4), 3);
  const Bytes stream = displaced_stream_of(mesh, 14);
  const std::size_t header = header_bytes(stream);
  Random random(3);
  const auto survives = [&](Bytes damaged) {
    try {
      for (const Vec3& p : decode(damaged, damaged.size()).positions)
        if (!p.allFinite()) return false;
    } catch (const Error& error) {
      return exit_status(error.cause()) == 3;
    }
    return true;
  };
  for (int trial = 0; trial < 300; ++trial) {
    Bytes damaged = stream;
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(stream.size()));
    damaged[at] ^= 1u << (trial % 8);
    // With the checksum set right, or no damage would get past it.
    try {
      if (at < header && trial % 4 != 0) seal_header(damaged);
    } catch (const Error&) {
    }
    CHECK(survives(damaged));
    damaged.resize(at);
    CHECK(survives(damaged));
  }
}

TEST_CASE("headers of displaced streams that claim the largest numbers decode to finite places") {
  Bytes connectivity;
  StreamHeader header;
  header.kind = StreamKind::Displaced;
  header.level = 3;
  header.base = encode_connectivity(shapes::icosahedron().faces, connectivity);
  header.base_planes = kMostControlPlanes;
  header.control.assign(header.base.vertices, {0, (1u << kMostControlPlanes) - 1, 12345});
  header.control[3] = {99, 1, (1u << kMostControlPlanes) - 1};
  header.origin = {std::int64_t{1} << 41, -(std::int64_t{1} << 41), 0};
  header.detail_planes = 31;
  for (int exponent : {500, -500})
    for (double grid : {std::ldexp(1.75, 499), std::ldexp(1.25, -499)})
      for (int value : {0, 0x55, 0xff}) {
        header.step_exponent = exponent;
        header.control_grid = grid;
        Bytes stream = write_header(header, connectivity);
        stream.insert(stream.end(), 200, static_cast<std::uint8_t>(value));
        const StreamHeader read = read_header(stream.data(), stream.data() + stream.size());
        CHECK(read.control == header.control);
        CHECK(read.control_grid == grid);
        try {
          for (const Vec3& p : decode(stream, stream.size()).positions) CHECK(p.allFinite());
        } catch (const Error& error) {
          CHECK(error.cause() == Cause::BadStream);
        }
      }
  header.control_grid = 1.0;
  header.origin[0] = (std::int64_t{1} << 41) + 1;
  const Bytes stream = write_header(header, connectivity);
  CHECK(cause_of([&] { decode(stream, stream.size()); }) == Cause::BadStream);
}

TEST_CASE("control points are exact, and no displacement at all is the smooth surface of them") {
  Progress silent;
  for (const Mesh& base : bases()) {
    SemiregularMesh mesh = samples::displaced(base, 2);
    mesh.positions = smooth_surface(mesh.levels(), mesh.control->points).points;
    StreamParts parts;
    const Bytes stream = encode_displaced(mesh, Wavelet::Butterfly, 2.0, 12 * kPassesPerPlane, silent, &parts);
    const StreamHeader header = read_header(stream.data(), stream.data() + stream.size());
    CHECK(header.kind == StreamKind::Displaced);
    CHECK(header.step_exponent <= 1 - 12);
    CHECK(header.control_grid == mesh.control->grid);
    const std::size_t payload = header_bytes(stream);
    CHECK(stream.size() - payload < 40u);
    CHECK(parts.header_bytes + parts.connectivity_bytes + static_cast<std::size_t>(parts.bits.base) / 8 == payload);
    Bytes unused;
    const std::vector<int> order = coded_vertex_order(mesh, encode_connectivity(mesh.base_faces, unused));
    const SemiregularMesh decoded =
        decode_displaced(header, 2, importance_level(header), stream.data() + payload, stream.data() + stream.size());
    for (int v = 0; v < mesh.base_vertices; ++v) CHECK(decoded.control->points[v] == mesh.control->points[order[v]]);
    for (std::size_t v = 0; v < order.size(); ++v)
      CHECK((decoded.positions[v] - mesh.positions[order[v]]).norm() < 1e-3);
  }
}
