#include "experiments/play/wasm_decoder.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <string>

#include "coder/codec.h"
#include "mesh/shapes.h"
#include "remesh/recover_levels.h"

using namespace gsp;

// The module's functions as they are here; as WebAssembly they are tested by tests/experiments/play.

namespace {

Bytes sphere_stream() {
  Progress silent;
  return encode(recover_levels(shapes::sphere(3)), {}, silent);
}

std::string error_text() { return gsp_error(); }

}  // namespace

TEST_CASE("the decoder for browsers gives what decode gives, to the bit, and coarser levels as its first vertices") {
  const Bytes stream = sphere_stream();
  GspStream* const opened = gsp_open(stream.data(), stream.size());
  REQUIRE(opened);
  CHECK(gsp_header_bytes(opened) == header_bytes(stream));
  for (std::size_t bytes : {header_bytes(stream), stream.size() / 3, stream.size()}) {
    const SemiregularMesh native = decode(stream, bytes);
    for (int finest : {10, native.level, 1, 0, -5}) {
      REQUIRE(gsp_decode(opened, bytes, finest) == 1);
      const int level = std::clamp(finest, 0, native.level);
      const SubdivisionLevel connectivity = native.levels()[level];
      REQUIRE(gsp_level(opened) == level);
      REQUIRE(gsp_vertex_count(opened) == connectivity.vertex_count);
      REQUIRE(gsp_face_count(opened) == connectivity.face_count());
      int differ = 0;
      for (int v = 0; v < connectivity.vertex_count; ++v)
        for (int k = 0; k < 3; ++k)
          differ += std::bit_cast<std::uint64_t>(gsp_positions(opened)[3 * v + k]) !=
                    std::bit_cast<std::uint64_t>(native.positions[v][k]);
      for (int f = 0; f < connectivity.face_count(); ++f)
        for (int k = 0; k < 3; ++k) differ += gsp_faces(opened)[3 * f + k] != connectivity.faces[f][k];
      CHECK(differ == 0);
      CHECK(gsp_crease_count(opened) == 0);
    }
  }
  gsp_close(opened);
}

TEST_CASE("the decoder for browsers tells the cause of what it refuses, and goes on") {
  Bytes stream = sphere_stream();
  CHECK(gsp_open(nullptr, 0) == nullptr);
  CHECK(error_text().rfind("bad-stream: ", 0) == 0);
  CHECK(gsp_open(stream.data(), header_bytes(stream) - 1) == nullptr);
  CHECK(error_text().rfind("truncated: ", 0) == 0);
  GspStream* const opened = gsp_open(stream.data(), stream.size());
  REQUIRE(opened);
  CHECK(gsp_decode(opened, 3, 10) == 0);
  CHECK(error_text().rfind("truncated: ", 0) == 0);
  CHECK(gsp_decode(opened, stream.size(), 10) == 1);
  gsp_close(opened);
  stream[12] ^= 1;
  CHECK(gsp_open(stream.data(), stream.size()) == nullptr);
  CHECK(error_text().rfind("bad-stream: ", 0) == 0);
}
